// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The style of the pages of all reports, and the document around them.

#include <string>

#include "report/html.h"

namespace forceshade::properties {

// Plots stay on white in the dark: their colours were chosen for it.
inline constexpr const char* kPageStyle = R"css(
:root {
  color-scheme: light dark;
  --page: #fbfaf7; --ink: #22262b; --quiet: #646b73; --line: #dcd9d1;
  --held: #0b6b57; --lacking: #8a6400; --failed: #b3400a; --tint: #f2f0ea;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #17191c; --ink: #e4e2dd; --quiet: #a0a5ab; --line: #383c41;
    --held: #6cc9b2; --lacking: #e0bd5a; --failed: #f39a63; --tint: #202327;
  }
  .legend { background: #fff; color: #4b5157; border-radius: 4px; padding: 5px 12px; width: fit-content; }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body {
  margin: 0; background: var(--page); color: var(--ink);
  font: 16px/1.55 Charter, "Bitstream Charter", "Iowan Old Style", "Source Serif 4", Cambria, Georgia, serif;
}
main { max-width: 1152px; margin: 0 auto; padding: 56px 24px 72px; }
header { border-bottom: 1px solid var(--line); padding-bottom: 28px; }
h1 { font-weight: 400; font-size: 21px; line-height: 1.3; margin: 0; color: var(--quiet); }
.verdict { font-size: clamp(56px, 9vw, 92px); line-height: 1.05; letter-spacing: -.02em; margin: 14px 0 18px; color: var(--held); }
.insufficient .verdict { color: var(--lacking); }
.failed .verdict { color: var(--failed); }
.statement { font-size: 20px; line-height: 1.5; max-width: 46em; margin: 0; }
.statement + .statement { margin-top: 10px; font-size: 16px; color: var(--quiet); }
h2 { font-weight: 600; font-size: 22px; margin: 52px 0 14px; }
h3 { font-weight: 600; font-size: 17px; margin: 0 0 6px; }
h3 span { font-weight: 400; color: var(--quiet); margin-right: .5em; }
table, .legend, h4, .facts, pre { font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
table { border-collapse: collapse; width: 100%; font-size: 12.5px; line-height: 1.4; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: 8px 6px; border-bottom: 1px solid var(--line); }
th:first-child { padding-left: 0; }
td:last-child, th:last-child { padding-right: 0; }
thead th { font-weight: 500; color: var(--quiet); vertical-align: bottom; padding-bottom: 5px; }
thead tr:first-child:not(:last-child) th { border-bottom: 0; padding-bottom: 2px; }
thead tr:first-child th[colspan]::after { content: ""; display: block; border-bottom: 1px solid var(--line); padding-top: 3px; }
sub, sup { line-height: 0; }
tbody th { font-weight: 600; white-space: nowrap; }
.number { text-align: right; }
td small { display: block; font-size: 11px; color: var(--quiet); white-space: nowrap; }
td .words { white-space: normal; }
.yes { color: var(--held); }
.lacking, .statement + .lacking { color: var(--lacking); }
.no { color: var(--failed); font-weight: 700; }
.note { font-size: 14px; color: var(--quiet); max-width: 56em; }
pre {
  font: 12.5px/1.5 ui-monospace, "SF Mono", Menlo, Consolas, monospace; background: var(--tint); border-left: 3px solid var(--failed);
  padding: 12px 14px; margin: 8px 0 16px; white-space: pre-wrap; overflow-wrap: anywhere;
}
.counterexamples h3 { margin-top: 20px; }
figure { margin: 0 0 52px; }
figcaption { font-size: 14.5px; line-height: 1.5; color: var(--quiet); max-width: 62em; margin-top: 12px; }
.legend { font-size: 13px; margin: 0 0 10px; }
.key { white-space: nowrap; margin-right: 1.2em; }
.key i { display: inline-block; width: 26px; border-top: 3px solid; vertical-align: middle; margin: 0 6px 2px 6px; }
.scale { width: 160px; height: 10px; vertical-align: -1px; margin: 0 4px; }
.panels { display: grid; gap: 14px; }
.three { grid-template-columns: repeat(auto-fill, minmax(min(330px, 100%), 1fr)); }
.four { grid-template-columns: repeat(auto-fill, minmax(min(250px, 100%), 1fr)); }
.two { grid-template-columns: repeat(auto-fill, minmax(min(460px, 100%), 1fr)); }
.panel { background: #fff; border: 1px solid var(--line); border-radius: 4px; padding: 10px 10px 4px; color: #22262b; min-width: 0; }
.panel h4 { font-size: 13px; font-weight: 600; line-height: 1.3; margin: 0 0 2px 2px; }
.panel h4 span { font-weight: 400; color: #646b73; margin-left: .6em; }
.panel svg { display: block; width: 100%; height: auto; }
.four .panel svg { max-width: 330px; }
.panel image { image-rendering: pixelated; }
.facts th { font-weight: 500; color: var(--quiet); width: 12em; }
.facts td { overflow-wrap: anywhere; }
.facts code { font: 12.5px/1.4 ui-monospace, "SF Mono", Menlo, Consolas, monospace; }
.limits { max-width: 48em; padding-left: 1.2em; }
.limits li { margin: 8px 0; }
@media screen and (max-width: 900px) {
  main { padding: 28px 16px 48px; }
  .statement { font-size: 18px; }
  .summary thead { display: none; }
  .summary tbody tr {
    display: grid; grid-template-columns: repeat(auto-fill, minmax(112px, 1fr)); gap: 10px 12px; padding: 16px 0;
    border-bottom: 1px solid var(--line);
  }
  .summary th, .summary td { display: block; border: 0; padding: 0; text-align: left; }
  .summary tbody th { grid-column: 1 / -1; font-size: 17px; }
  .summary td::before { content: attr(data-label); display: block; font-size: 11.5px; color: var(--quiet); }
  .facts th { width: 8.5em; }
}
@media print {
  :root { --page: #fff; --ink: #000; --quiet: #444; --line: #bbb; --held: #0b6b57; --failed: #b3400a; --tint: #fff; }
  @page { size: A4; margin: 14mm 13mm; }
  main { padding: 0; max-width: none; }
  body { font-size: 10.5pt; }
  table { font-size: 6.6pt; }
  th, td { padding: 3px 3px; }
  td small { font-size: 6pt; }
  .facts table, .facts { font-size: 9pt; }
  .three { grid-template-columns: repeat(3, 1fr); }
  .four { grid-template-columns: repeat(4, 1fr); }
  .two { grid-template-columns: repeat(2, 1fr); }
  .panels { gap: 6px; }
  .panel h4 { font-size: 7.5pt; }
  .panel, tr, li, h3 { break-inside: avoid; }
  h2, h3, .legend { break-after: avoid; }
  .verdict { font-size: 48pt; margin: 6pt 0 8pt; }
}
)css";

// A page that needs no file and no network. title: as text; body: HTML; style: what this page adds to that of all.
inline std::string document(const std::string& title, const std::string& body, const std::string& style = "") {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(title) + "</title>\n<style>" + kPageStyle + style + "</style>\n</head>\n<body>\n<main>\n" + body +
         "</main>\n</body>\n</html>\n";
}

}  // namespace forceshade::properties
