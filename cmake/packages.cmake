# `cpack -G DEB` in the build folder makes Debian packages of what install.cmake installs, one for each component but `licence`,
# which Debian has as the file copyright. scripts/package configures, builds and packs.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME forceshade)
set(CPACK_PACKAGE_VENDOR "the forceshade authors")
set(CPACK_PACKAGE_CONTACT "The forceshade authors <forceshade@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL libforceshade0 libforceshade-reference0 libforceshade-dev forceshade)
if(FORCESHADE_PYTHON_FOUND)
  list(APPEND CPACK_COMPONENTS_ALL python3-forceshade)
endif()
set(debian ${PROJECT_SOURCE_DIR}/cmake/debian)
set(CPACK_PROJECT_CONFIG_FILE ${debian}/site.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${debian}/finish.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# forceshade_package(COMPONENT SECTION TEXT [DEPENDS]): names are those of the component, lines are those of the description.
function(forceshade_package component section text)
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${component} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${about}\n${text}" PARENT_SCOPE)
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${about}\n${text}" PARENT_SCOPE)
  if(ARGN)
    list(JOIN ARGN ", " depends)
    set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  endif()
endfunction()
set(about "forceshade computes the forces of haptic rendering: the force laws of\nMorgenbesser and Srinivasan (RLE Technical Report 606, MIT, 1996), height\nmaps and triangle meshes. Each component of each force is the exact force\nrounded to binary32.\n.")
forceshade_package(libforceshade0 libs
                   "This package has the shared library of the C interface.")
# It refuses to certify a libforceshade0 of another build.
forceshade_package(libforceshade-reference0 libs
                   "This package has the shared library of the C interface of the exact side:\nforces in decimal digits, property tests and certificates."
                   "libforceshade0 (= ${PROJECT_VERSION})")
forceshade_package(libforceshade-dev libdevel
                   "This package has the headers and what a linker needs: the shared\nlibraries for C, and static libraries for C++20."
                   "libforceshade0 (= ${PROJECT_VERSION})" "libforceshade-reference0 (= ${PROJECT_VERSION})" libeigen3-dev
                   libcsv-dev libpng-dev libtiff-dev libtomlplusplus-dev libssl-dev libsqlite3-dev libmpfi-dev libmpfr-dev libgmp-dev libboost-dev nlohmann-json3-dev)
forceshade_package(forceshade science
                   "This package has the command, which computes and certifies forces and drives\ndevices."
                   python3)  # of forceshade-standin
math(EXPR next "${Python3_VERSION_MINOR} + 1")
forceshade_package(python3-forceshade python
                   "This package is for Python: forces as NumPy arrays, sessions, exact forces as\nfractions or digits, properties and certificates."
                   "python3 (>= 3.${Python3_VERSION_MINOR})" "python3 (<< 3.${next})" python3-numpy)
forceshade_package(forceshade-doc doc
                   "This package has the pages and the reference of the interfaces for C, C++ and\nPython, for a browser.")
set(CPACK_DEBIAN_FORCESHADE-DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_FORCESHADE-DOC_PACKAGE_SHLIBDEPS OFF)
foreach(library IN ITEMS libforceshade libforceshade-reference)
  string(TOUPPER ${library} key)
  set(shlibs ${PROJECT_BINARY_DIR}/debian/${library}/shlibs)
  file(CONFIGURE OUTPUT ${shlibs} CONTENT "${library} 0 ${library}0 (>= ${PROJECT_VERSION})\n")
  set(CPACK_DEBIAN_${key}0_PACKAGE_CONTROL_EXTRA ${debian}/triggers ${shlibs})
endforeach()
# The folder in which dpkg-shlibdeps finds libforceshade.so.0 while the packages are made.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/bindings/c)
set(CPACK_DEBIAN_FORCESHADE_PACKAGE_RECOMMENDS gnuplot-nox)
foreach(package IN ITEMS FORCESHADE LIBFORCESHADE-DEV PYTHON3-FORCESHADE)
  set(CPACK_DEBIAN_${package}_PACKAGE_SUGGESTS forceshade-doc)
endforeach()
set(CPACK_DEBIAN_FORCESHADE_PACKAGE_SUGGESTS "forceshade-doc, python3-websockets")  # the latter for forceshade-standin
set(CPACK_DEBIAN_LIBFORCESHADE-DEV_PACKAGE_SHLIBDEPS OFF)
include(CPack)
