# Run by CPack before it makes packages: adds forceshade-doc, in which finish.cmake builds the site, where the tools for it are there.
find_program(DOXYGEN doxygen)
find_program(MKDOCS mkdocs)
find_path(MKDOCS_MATERIAL material/base.html PATHS /usr/share/mkdocs/themes)
if(DOXYGEN AND MKDOCS AND MKDOCS_MATERIAL)
  list(APPEND CPACK_COMPONENTS_ALL forceshade-doc)
else()
  message("no package forceshade-doc: it needs the Debian packages doxygen and mkdocs-material")
endif()
