# A library of this project: warnings on, no contraction of a*b+c into an fma (the proofs count every rounding).
function(forceshade_library name)
  add_library(${name} STATIC ${ARGN})
  forceshade_compile_options(${name})
  forceshade_position_independent(${name})
  forceshade_unite(${name})
endfunction()

# The libraries are static, and a plugin, a module of Python or a game engine is a shared object. No function of theirs is meant
# to be replaced by another one at run time, so that calls within a file may still be inlined.
function(forceshade_position_independent name)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${name} PRIVATE -fno-semantic-interposition)
endfunction()

# For code that no tick runs: it takes half as long to compile, and is no slower where the time goes to multiprecision numbers.
function(forceshade_compile_quickly name)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Compiles the target's files eight at a time: CLI11, CGAL and RapidCheck are headers, and each translation unit compiles again
# what it uses of them. Names in the unnamed namespaces of one target's files must therefore differ.
function(forceshade_unite name)
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${FORCESHADE_UNITE} UNITY_BUILD_BATCH_SIZE 8)
  if(FORCESHADE_UNITE)
    # g++ takes a file that another one includes for a header.
    target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# Lets a target, and what links it, include the headers of these modules as forceshade/<module>/<file>: include/<module> holds a
# link to the module's folder and nothing else, so that no module can include what it does not link.
function(forceshade_sees name)
  foreach(module IN LISTS ARGN)
    target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include/${module}>)
  endforeach()
endfunction()

function(forceshade_compile_options name)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE folder)
  string(REGEX REPLACE "/.*" "" module ${folder})
  forceshade_sees(${name} ${module} vocabulary)
  target_include_directories(${name} PUBLIC $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
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
  # A precompiled header is of one instruction set.
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options}" SKIP_PRECOMPILE_HEADERS ON)
endfunction()
