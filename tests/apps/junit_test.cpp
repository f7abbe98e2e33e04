// SPDX-License-Identifier: BSD-3-Clause
#include "apps/junit.h"

#include <gtest/gtest.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <sstream>

#include "files/printable.h"

namespace forceshade::apps {
namespace {

using boost::property_tree::ptree;

ptree parsed(const std::string& xml) {
  std::istringstream in(xml);
  ptree tree;
  boost::property_tree::read_xml(in, tree);
  return tree;
}

// XML 1.0, "Char": nothing else may stand in a document, not even as a reference.
void expect_only_characters_of_xml(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size = files::character_size(text);
    ASSERT_GT(size, 0U) << "not UTF-8 at " << text;
    const auto byte = static_cast<unsigned char>(text[0]);
    EXPECT_TRUE(byte >= 0x20 || byte == '\t' || byte == '\n' || byte == '\r') << int{byte};
    EXPECT_NE(text.substr(0, size), "\xEF\xBF\xBE");
    EXPECT_NE(text.substr(0, size), "\xEF\xBF\xBF");
    text.remove_prefix(size);
  }
}

TEST(junit, counts_cases_failures_and_time_of_each_subject) {
  const ptree tree = parsed(to_junit("checks", {{"seed", "7"}},
                                     {{"wall", "equivalence", 0.25, std::nullopt, "10 cases"},
                                      {"wall", "passivity", 0.5, "at 0: 1 mJ"},
                                      {"bump-2p", "equivalence", 1.0, ""}}));
  const ptree& all = tree.get_child("testsuites");
  EXPECT_EQ(all.get<std::string>("<xmlattr>.name"), "checks");
  EXPECT_EQ(all.get<int>("<xmlattr>.tests"), 3);
  EXPECT_EQ(all.get<int>("<xmlattr>.failures"), 2);
  EXPECT_EQ(all.get<std::string>("<xmlattr>.time"), "1.750");
  ASSERT_EQ(all.count("testsuite"), 2U);
  const ptree& wall = all.get_child("testsuite");
  EXPECT_EQ(wall.get<std::string>("<xmlattr>.name"), "wall");
  EXPECT_EQ(wall.get<int>("<xmlattr>.tests"), 2);
  EXPECT_EQ(wall.get<int>("<xmlattr>.failures"), 1);
  EXPECT_EQ(wall.get<int>("<xmlattr>.errors"), 0);
  EXPECT_EQ(wall.get<std::string>("properties.property.<xmlattr>.value"), "7");
  ASSERT_EQ(wall.count("testcase"), 2U);
  const ptree &held = wall.get_child("testcase"), &failed = std::next(wall.begin(), 3)->second;
  EXPECT_EQ(held.get<std::string>("<xmlattr>.classname"), "checks.wall");
  EXPECT_EQ(held.get<std::string>("<xmlattr>.name"), "equivalence");
  EXPECT_EQ(held.get<std::string>("<xmlattr>.time"), "0.250");
  EXPECT_EQ(held.get<std::string>("system-out"), "10 cases");
  EXPECT_EQ(held.count("failure"), 0U);
  EXPECT_EQ(failed.get<std::string>("failure"), "at 0: 1 mJ");
  EXPECT_EQ(failed.get<std::string>("failure.<xmlattr>.message"), "at 0: 1 mJ");
  EXPECT_EQ(failed.count("system-out"), 0U);
}

TEST(junit, keeps_every_name_and_lets_none_break_the_document) {
  const std::vector<std::pair<std::string, std::string>> names{
      {"a<b>&\"c'", "a<b>&\"c'"},
      {"]]><!--", "]]><!--"},
      {"</testcase></testsuite>", "</testcase></testsuite>"},
      {"&lt;&#10;", "&lt;&#10;"},
      {"höhe µ 😀.toml", "höhe µ 😀.toml"},
      {std::string("nul\0bell\a", 9), "nul\\x00bell\\x07"},
      {"tab\tand\x1b[2J", "tab\\x09and\\x1b[2J"},
      {"\xff\xfe\xc2", "\\xff\\xfe\\xc2"},
      {"\xed\xa0\x80", "\\xed\\xa0\\x80"},  // half of a surrogate pair
      {"\xef\xbf\xbf\xef\xbf\xbe", "\\xef\\xbf\\xbf\\xef\\xbf\\xbe"},
  };
  for (const auto& [name, shown] : names) {
    const std::string xml = to_junit(name, {{name, name}}, {{name, name, 0, name, name}});
    expect_only_characters_of_xml(xml);
    const ptree tree = parsed(xml);
    EXPECT_EQ(tree.get<std::string>("testsuites.<xmlattr>.name"), shown);
    EXPECT_EQ(tree.get<std::string>("testsuites.testsuite.<xmlattr>.name"), shown);
    EXPECT_EQ(tree.get<std::string>("testsuites.testsuite.properties.property.<xmlattr>.name"), shown);
    EXPECT_EQ(tree.get<std::string>("testsuites.testsuite.testcase.<xmlattr>.name"), shown);
    EXPECT_EQ(tree.get<std::string>("testsuites.testsuite.testcase.failure.<xmlattr>.message"), shown);
    EXPECT_EQ(tree.get<std::string>("testsuites.testsuite.testcase.failure"), shown);
    EXPECT_EQ(tree.get<std::string>("testsuites.testsuite.testcase.system-out"), shown);
    EXPECT_EQ(tree.get_child("testsuites").count("testsuite"), 1U);
  }
}

TEST(junit, keeps_the_lines_of_a_text_and_shows_the_first_one_as_a_message) {
  const ptree tree = parsed(to_junit("checks", {{"a\nb", "c"}}, {{"wall", "forces", 0, "one <\ntwo\a\n", "\nthree"}}));
  const ptree& suite = tree.get_child("testsuites.testsuite");
  EXPECT_EQ(suite.get<std::string>("properties.property.<xmlattr>.name"), "a\\nb");
  EXPECT_EQ(suite.get<std::string>("testcase.failure.<xmlattr>.message"), "one <");
  EXPECT_EQ(suite.get<std::string>("testcase.failure"), "one <\ntwo\\x07\n");
  EXPECT_EQ(suite.get<std::string>("testcase.system-out"), "\nthree");
}

}  // namespace
}  // namespace forceshade::apps
