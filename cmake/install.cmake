include(CMakePackageConfigHelpers)

# Components are the packages of packages.cmake.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME libforceshade-dev)

# The public headers: no other header is installed. Those of fast and device need no more than Eigen.
set(modules rendering files fast device)
if(FORCESHADE_EXACT_SIDE)
  set(modules ${forceshade_modules})
endif()
foreach(module IN LISTS modules)
  foreach(header IN LISTS forceshade_public_headers_of_${module})
    install(FILES include/forceshade/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/forceshade)
  endforeach()
endforeach()

install(TARGETS forceshade_fast forceshade_system forceshade_files forceshade_device EXPORT forceshade_targets)
set(export_sets forceshade_targets)
if(FORCESHADE_EXACT_SIDE)
  install(TARGETS forceshade COMPONENT forceshade)
  install(TARGETS forceshade-object DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/forceshade COMPONENT forceshade)
  # For every language: two shared libraries, each with its one header.
  set_target_properties(forceshade_c PROPERTIES EXPORT_NAME c)
  install(TARGETS forceshade_c EXPORT forceshade_c_targets LIBRARY COMPONENT libforceshade0 NAMELINK_COMPONENT libforceshade-dev)
  set_target_properties(forceshade_reference_c PROPERTIES EXPORT_NAME reference-c)
  install(TARGETS forceshade_reference_c EXPORT forceshade_reference-c_targets LIBRARY COMPONENT libforceshade-reference0
          NAMELINK_COMPONENT libforceshade-dev)
  install(FILES include/forceshade.h include/forceshade_reference.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(PROGRAMS tests/stand_ins/forceshade-standin DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT forceshade)
  install(FILES tests/stand_ins/forceshade-standin.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT forceshade)
  install(DIRECTORY tests/stand_ins/haply DESTINATION ${CMAKE_INSTALL_DATADIR}/forceshade/stand_ins COMPONENT forceshade
          PATTERN __pycache__ EXCLUDE)
  install(DIRECTORY tests/stand_ins/dhd DESTINATION ${CMAKE_INSTALL_DATADIR}/forceshade/stand_ins COMPONENT forceshade
          FILES_MATCHING PATTERN *.py)
  install(TARGETS stand_in_dhd LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/forceshade COMPONENT forceshade NAMELINK_SKIP)
  set(made ${PROJECT_BINARY_DIR}/apps/documentation)
  install(DIRECTORY ${made}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT forceshade)
  install(FILES ${made}/forceshade DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT forceshade)
  install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT forceshade)
  install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT forceshade)
  install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT forceshade PATTERN node_modules EXCLUDE)
  # The site itself is built in the package's folder (cmake/debian/finish.cmake).
  install(FILES cmake/debian/forceshade-doc.doc-base DESTINATION ${CMAKE_INSTALL_DATADIR}/doc-base RENAME forceshade-doc.forceshade
          COMPONENT forceshade-doc EXCLUDE_FROM_ALL)
  # A library that needs more than Eigen is a component of its own: find_package(forceshade COMPONENTS c reference-c heights
  # meshes subjects run properties).
  # Each component's libraries, and the components that it links.
  set(libraries_of_heights toml heights)
  set(libraries_of_meshes meshes)
  set(libraries_of_subjects subjects)
  set(libraries_of_run identity renderer certificate recorder run)
  set(libraries_of_properties reference properties certify)
  list(APPEND export_sets forceshade_c_targets forceshade_reference-c_targets)
  foreach(component IN ITEMS heights meshes subjects run properties)
    foreach(library IN LISTS libraries_of_${component})
      set_target_properties(forceshade_${library} PROPERTIES EXPORT_NAME ${library})
      install(TARGETS forceshade_${library} EXPORT forceshade_${component}_targets)
    endforeach()
    list(APPEND export_sets forceshade_${component}_targets)
  endforeach()
  # The parts that this project's own clients (clients/) are made of: libraries, and headers by the names that the tree has for them. They
  # may change with every version, so no Debian package has them.
  add_library(forceshade_kit INTERFACE)
  target_include_directories(forceshade_kit INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/forceshade/kit>)
  target_link_libraries(forceshade_kit INTERFACE forceshade_program forceshade_report forceshade_window CLI11::CLI11
                        nlohmann_json::nlohmann_json forceshade_toml)
  foreach(library IN ITEMS kit command_parts program report window)
    set_target_properties(forceshade_${library} PROPERTIES EXPORT_NAME ${library})
    install(TARGETS forceshade_${library} EXPORT forceshade_kit_targets COMPONENT kit)
  endforeach()
  install(EXPORT forceshade_kit_targets NAMESPACE forceshade:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/forceshade COMPONENT kit)
  install(DIRECTORY apps certificate device files properties rendering report run subjects system text window
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/forceshade/kit COMPONENT kit
          FILES_MATCHING PATTERN *.h PATTERN *.inc)
endif()
foreach(set IN LISTS export_sets)
  install(EXPORT ${set} NAMESPACE forceshade:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/forceshade)
endforeach()
configure_package_config_file(cmake/forceshade-config.cmake.in forceshade-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/forceshade)
write_basic_package_version_file(forceshade-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/forceshade-config.cmake ${PROJECT_BINARY_DIR}/forceshade-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/forceshade)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)

# For pkg-config. All libraries are static, so what they need is not private; paths are relative to the .pc file, because the
# prefix may change when the build is installed.
file(RELATIVE_PATH PC_TO_PREFIX "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
function(install_pc name)
  cmake_parse_arguments(PC "" "DESCRIPTION;REQUIRES;LIBRARIES" "" ${ARGN})
  set(PC_NAME ${name})
  configure_file(cmake/forceshade.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
install_pc(forceshade DESCRIPTION "${PROJECT_DESCRIPTION}" REQUIRES "eigen3 >= 3.4"
           LIBRARIES "-lforceshade_device -lforceshade_fast -lforceshade_files -lforceshade_system -lcsv -ldl -pthread")
if(FORCESHADE_EXACT_SIDE)
  install_pc(forceshade-c DESCRIPTION "${PROJECT_DESCRIPTION}, for C and other languages" LIBRARIES "-lforceshade")
  install_pc(forceshade-reference DESCRIPTION "Exact forces, property tests and certificates, for C and other languages"
             REQUIRES "forceshade-c" LIBRARIES "-lforceshade-reference")
  install_pc(forceshade-heights DESCRIPTION "Height maps from TOML, image and array files"
             REQUIRES "forceshade, libpng, libtiff-4, tomlplusplus" LIBRARIES "-lforceshade_heights -lforceshade_toml")
  install_pc(forceshade-meshes DESCRIPTION "Triangle meshes from files, checked and repaired"
             REQUIRES "forceshade" LIBRARIES "-lforceshade_meshes -pthread")
  set(run_libraries "-lforceshade_run -lforceshade_recorder -lforceshade_certificate -lforceshade_renderer -lforceshade_identity")
  install_pc(forceshade-run DESCRIPTION "Certified runs of the servo loop" REQUIRES "forceshade, libcrypto, sqlite3"
             LIBRARIES "${run_libraries}")
  install_pc(forceshade-properties DESCRIPTION "Properties that a haptic renderer must have, and certificates of them"
             REQUIRES "forceshade-run, forceshade-subjects"
             LIBRARIES "-lforceshade_certify -lforceshade_properties -lforceshade_reference -lmpfi -lmpfr -lgmp")
  install_pc(forceshade-subjects DESCRIPTION "Laws, height maps and meshes from subject files"
             REQUIRES "forceshade-heights, forceshade-meshes" LIBRARIES "-lforceshade_subjects")
endif()
