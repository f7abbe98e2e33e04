include(CMakePackageConfigHelpers)

install(TARGETS forceshade_fast forceshade_csv forceshade_device EXPORT forceshade_targets)
if(TARGET forceshade)
  install(TARGETS forceshade)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/apps/documentation/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
  install(FILES ${PROJECT_BINARY_DIR}/apps/documentation/forceshade
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endif()
foreach(folder vocabulary fast csv device)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/forceshade FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT forceshade_targets NAMESPACE forceshade:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/forceshade)
configure_package_config_file(cmake/forceshade-config.cmake.in forceshade-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/forceshade)
write_basic_package_version_file(forceshade-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/forceshade-config.cmake ${PROJECT_BINARY_DIR}/forceshade-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/forceshade)
