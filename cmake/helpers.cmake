# A library of this project: warnings on, no contraction of a*b+c into an fma (the proofs count every rounding).
function(forceshade_library name)
  add_library(${name} STATIC ${ARGN})
  forceshade_compile_options(${name})
  forceshade_position_independent(${name})
  forceshade_unite(${name} 16)  # in three quarters of the time that eight at a time take
endfunction()

# The libraries are static, and a plugin, a module of Python or a game engine is a shared object. No function of theirs is meant
# to be replaced by another one at run time, so that calls within a file may still be inlined.
# Nor is any of them a symbol of that shared object, where two of them could take each other's.
function(forceshade_position_independent name)
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${name} PRIVATE -fno-semantic-interposition)
endfunction()

# For code that no tick runs: it takes half as long to compile, and is no slower where the time goes to multiprecision numbers.
function(forceshade_compile_quickly name)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Compiles the target's files as many at a time, eight unless a number is given: CLI11 and CGAL are headers, and each translation unit
# compiles again what it uses of them. Names in the unnamed namespaces of one target's files must therefore differ.
function(forceshade_unite name)
  set(count 8 ${ARGN})
  list(GET count -1 count)
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${FORCESHADE_UNITE} UNITY_BUILD_BATCH_SIZE ${count})
  if(FORCESHADE_UNITE)
    # g++ takes a file that another one includes for a header.
    target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# The modules of modules.txt, and in forceshade_sees_<module> what each may include.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/modules.txt lines REGEX "^[^#]")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/modules.txt)
list(TRANSFORM lines REPLACE ":.*" "" OUTPUT_VARIABLE forceshade_modules)
file(REMOVE_RECURSE ${PROJECT_BINARY_DIR}/links)
foreach(line IN LISTS lines)
  string(REGEX MATCH "^([^:]+): ?(.*)$" matched "${line}")
  set(module ${CMAKE_MATCH_1})
  string(REPLACE " " ";" seen "${CMAKE_MATCH_2}")
  if(seen STREQUAL "*")
    set(seen ${forceshade_modules})
  endif()
  set(forceshade_sees_${module} ${module} ${seen})

  # Includes are written from the root of the sources. links/<module> holds links to the files and folders of this module alone,
  # so that a target with it on its path cannot include a module that lies in a folder of this one.
  file(GLOB entries RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${module}/*)
  list(REMOVE_ITEM entries ${forceshade_modules})
  set(links ${PROJECT_BINARY_DIR}/links/${module})
  foreach(entry IN LISTS entries)
    cmake_path(GET entry PARENT_PATH folder)
    file(MAKE_DIRECTORY ${links}/${folder})
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${entry} ${links}/${entry} SYMBOLIC)
  endforeach()
endforeach()

# The public headers, each linked into the folder of its module alone.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/public_headers.txt lines REGEX "^[^#]")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/public_headers.txt)
foreach(line IN LISTS lines)
  string(REGEX MATCH "^([^:]+): (.+)$" matched "${line}")
  set(header ${CMAKE_MATCH_1})
  set(module ${CMAKE_MATCH_2})
  if(NOT module IN_LIST forceshade_modules)
    message(FATAL_ERROR "cmake/public_headers.txt: expected a module of cmake/modules.txt for ${header}, got ${module}")
  endif()
  list(APPEND forceshade_public_headers_of_${module} ${header})
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/links/${module}/forceshade)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/include/forceshade/${header} ${PROJECT_BINARY_DIR}/links/${module}/forceshade/${header} SYMBOLIC)
endforeach()

# Warnings, the language, and the headers that the target's module may include.
function(forceshade_compile_options name)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE module)
  while(NOT module IN_LIST forceshade_modules)
    cmake_path(GET module PARENT_PATH module)
  endwhile()
  foreach(seen IN LISTS forceshade_sees_${module})
    target_include_directories(${name} PRIVATE ${PROJECT_BINARY_DIR}/links/${seen})
  endforeach()
  if(PROJECT_IS_TOP_LEVEL)
    target_include_directories(${name} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  else()
    target_include_directories(${name} INTERFACE ${PROJECT_SOURCE_DIR}/include)
  endif()
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_compile_options(${name} PUBLIC -ffp-contract=off PRIVATE -Wall -Wextra -Wconversion)
  # A translation unit takes less than 1 GB: g++ need not collect what it no longer uses, which took a tenth of its time.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)
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
