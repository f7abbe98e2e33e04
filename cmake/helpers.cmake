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

# Sources for one instruction set alone.
function(forceshade_vector_sources set)
  if(set STREQUAL "avx2")
    set(options "-mavx2;-mfma")
  else()
    # g++ 12 warns about its own intrinsics header (GCC bug 105593).
    set(options
        "-mavx512f;-mavx512dq;-mavx512vl;-mavx512bw;$<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized;-Wno-maybe-uninitialized>")
  endif()
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options}")
endfunction()
