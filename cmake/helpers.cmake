# A library of this project: warnings on, no contraction of a*b+c into an fma (the proofs count every rounding).
function(forceshade_library name)
  add_library(${name} STATIC ${ARGN})
  forceshade_compile_options(${name})
endfunction()

function(forceshade_compile_options name)
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
                                            $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_compile_options(${name} PUBLIC -ffp-contract=off PRIVATE -Wall -Wextra -Wconversion)
  if(FORCESHADE_WERROR)
    target_compile_options(${name} PRIVATE -Werror)
  endif()
endfunction()
