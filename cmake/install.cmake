include(CMakePackageConfigHelpers)

# The headers that a program of somebody else's may include, and what these include in turn; no other header is installed.
# tests/install compares this list with what the offered headers reach.
function(install_headers module)
  foreach(header IN LISTS ARGN)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${module}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/forceshade/${module}/${folder})
  endforeach()
endfunction()
install_headers(rendering breakdown.h description.h height_map.h law.h mesh.h mesh_rendering.h monitor.h results.h)
file(GLOB law_headers RELATIVE ${PROJECT_SOURCE_DIR}/fast CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/fast/laws/*.h)
install_headers(fast domain.h evaluate.h god_object.h height_map_field.h heights/force.h heights/grid.h heights/jet.h heights/shape.h
                heights/spline.h heights/spline_force.h instruction_set.h law.h ${law_headers} numbers/arithmetic.h
                numbers/ball.h numbers/big_float_ball.h numbers/double_double.h numbers/double_with_error.h
                numbers/first_stage.h numbers/inline.h numbers/row.h session.h simd/batch.h stage.h)
install_headers(files bad_input.h csv.h)
install_headers(device attendant.h device.h hand_speed.h last_samples.h limited.h null.h open_device.h oscillation.h
                passivity_controller.h placement.h real_time.h replay.h sample.h sent_forces.h servo_loop.h
                shortened.h simulated/arm.h simulated/friction.h simulated/hand.h simulated/model.h simulated/motor.h
                simulated/plant.h simulated/simulated.h simulated/steering.h supervisor.h timing.h triple_buffer.h)

install(TARGETS forceshade_fast forceshade_files forceshade_device EXPORT forceshade_targets)
set(export_sets forceshade_targets)
if(NOT FORCESHADE_FAST_ONLY)
  install(TARGETS forceshade)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/apps/documentation/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
  install(FILES ${PROJECT_BINARY_DIR}/apps/documentation/forceshade
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${PROJECT_BINARY_DIR}/apps/documentation/_forceshade DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${PROJECT_BINARY_DIR}/apps/documentation/forceshade.fish
          DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  # What needs more than Eigen is a component of its own: find_package(forceshade COMPONENTS heights meshes run properties).
  install_headers(rendering/heights load.h spec.h)
  install_headers(rendering/meshes check.h facts.h load.h normals.h repair.h)
  install_headers(rendering/identity identity.h mesh_identity.h)
  install_headers(rendering/renderer renderer.h rendering.h)
  install_headers(device/run certified.h run.h)
  install_headers(reference height_map_field.h heights/outline.h law.h laws/bump_geometry.h laws/force.h meshes/god_object.h numbers/ball64.h
                  position.h)
  install_headers(properties field_subject.h height_map_subject.h height_map_claims.h law_claims.h law_subject.h mesh_subject.h positions.h rendered.h
                  run.h subject.h)
  install_headers(certificate certificate.h certify.h evidence.h sweep.h)
  # Each component's libraries, and the components that it links.
  set(libraries_of_heights heights)
  set(libraries_of_meshes meshes)
  set(libraries_of_run identity renderer certificate recorder run)
  set(libraries_of_properties reference properties certify)
  foreach(component IN ITEMS heights meshes run properties)
    foreach(library IN LISTS libraries_of_${component})
      set_target_properties(forceshade_${library} PROPERTIES EXPORT_NAME ${library})
      install(TARGETS forceshade_${library} EXPORT forceshade_${component}_targets)
    endforeach()
    list(APPEND export_sets forceshade_${component}_targets)
  endforeach()
endif()
foreach(set IN LISTS export_sets)
  install(EXPORT ${set} NAMESPACE forceshade:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/forceshade)
endforeach()
configure_package_config_file(cmake/forceshade-config.cmake.in forceshade-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/forceshade)
write_basic_package_version_file(forceshade-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/forceshade-config.cmake ${PROJECT_BINARY_DIR}/forceshade-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/forceshade)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

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
           LIBRARIES "-lforceshade_device -lforceshade_fast -lforceshade_files -lcsv -ldl -pthread")
if(NOT FORCESHADE_FAST_ONLY)
  install_pc(forceshade-heights DESCRIPTION "Height maps from TOML, image and array files"
             REQUIRES "forceshade, libpng, libtiff-4, tomlplusplus" LIBRARIES "-lforceshade_heights")
  install_pc(forceshade-meshes DESCRIPTION "Triangle meshes from files, checked and repaired"
             REQUIRES "forceshade" LIBRARIES "-lforceshade_meshes -lmpfi -lmpfr -lgmp -pthread")
  set(run_libraries "-lforceshade_run -lforceshade_recorder -lforceshade_certificate -lforceshade_renderer -lforceshade_identity")
  install_pc(forceshade-run DESCRIPTION "Certified runs of the servo loop" REQUIRES "forceshade, libcrypto, sqlite3"
             LIBRARIES "${run_libraries}")
  install_pc(forceshade-properties DESCRIPTION "Properties that a haptic renderer must have, and certificates of them"
             REQUIRES "forceshade-run"
             LIBRARIES "-lforceshade_certify -lforceshade_properties -lforceshade_reference -lrapidcheck -lmpfi -lmpfr -lgmp")
endif()
