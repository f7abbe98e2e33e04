# The features of a build beside laws, height maps, meshes and the C interface for them. A full build has every feature, and
# requires the packages that they need. For a machine that lacks some of them, FORCESHADE_FEATURES names those to build, and
# forceshade_has() of the C interface answers 0 for the others.
#
#   device-loop    devices and the servo loop: Linux, libcsv
#   subject-files  subject files with meshes, and height maps from NPY and PFM files: toml++, of which the headers are enough
#   image-files    in subject files, height maps and textures from PNG and TIFF files: libpng, libtiff
#   csv-files      in subject files, motions from CSV files: libcsv
#   certificates   certificates are read, and digests are made: libcsv, OpenSSL's libcrypto, nlohmann_json
#   exact-side     the exact side, the command, Python, devices that speak JSON: more packages. It brings all of the above
set(known device-loop subject-files image-files csv-files certificates exact-side)
set(usual ${known})
if(NOT PROJECT_IS_TOP_LEVEL)
  set(usual device-loop)  # forceshade::fast and forceshade::device, as find_package(forceshade) without components has them
endif()
set(FORCESHADE_FEATURES ${usual} CACHE STRING "The features of ${known} to build; empty for none")
if("exact-side" IN_LIST FORCESHADE_FEATURES)
  set(FORCESHADE_FEATURES ${known})
endif()
foreach(feature IN LISTS FORCESHADE_FEATURES)
  if(NOT feature IN_LIST known)
    list(JOIN known ", " words)
    message(FATAL_ERROR "FORCESHADE_FEATURES: expected some of ${words}, with semicolons between them; got ${feature}")
  endif()
endforeach()

# forceshade_has(VARIABLE FEATURES...): whether the build has one of them.
function(forceshade_has variable)
  set(${variable} OFF PARENT_SCOPE)
  foreach(feature IN LISTS ARGN)
    if(feature IN_LIST FORCESHADE_FEATURES)
      set(${variable} ON PARENT_SCOPE)
    endif()
  endforeach()
endfunction()
foreach(feature IN LISTS known)
  string(TOUPPER "forceshade_${feature}" variable)
  string(REPLACE "-" "_" variable ${variable})
  forceshade_has(${variable} ${feature})  # FORCESHADE_DEVICE_LOOP and so on
endforeach()
forceshade_has(FORCESHADE_READS_CSV device-loop csv-files certificates)
forceshade_has(FORCESHADE_WRITES_FILES device-loop certificates)

# Required of every machine: binary64 whose every operation is rounded to binary64. FLT_EVAL_METHOD is 2 where g++ computes with
# the registers of the x87, as it does for i386, whose significands of 64 bits would round each result twice.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("static_assert(__FLT_EVAL_METHOD__ == 0);
int main() {}" FORCESHADE_ROUNDS_EACH_OPERATION)
if(NOT FORCESHADE_ROUNDS_EACH_OPERATION)
  message(FATAL_ERROR "This compiler keeps numbers in a format wider than theirs (FLT_EVAL_METHOD is not 0), as for i386, where the registers "
                      "of the x87 round each result twice. Every proof needs operations that are rounded to binary64. Expected a "
                      "target with such operations: x86-64, AArch64 or WebAssembly.")
endif()
check_cxx_source_compiles("__extension__ using Wide = unsigned __int128;
int main() {}" FORCESHADE_MULTIPLIES_64_BITS)
if(NOT FORCESHADE_MULTIPLIES_64_BITS)
  message(FATAL_ERROR "This compiler has no unsigned __int128, of which the wide numbers of fast/numbers/ are made. Expected g++ or clang++ for a "
                      "64-bit target, or for WebAssembly.")
endif()

# The headers of Boost, Eigen and toml++ are the same for every target: a build for another machine takes those of this one, by links
# where headers of this machine alone lie beside them.
set(FORCESHADE_HEADERS)
if(CMAKE_CROSSCOMPILING)
  find_path(FORCESHADE_BOOST boost/multiprecision/cpp_int.hpp REQUIRED NO_CMAKE_FIND_ROOT_PATH PATHS /usr/include)
  set(FORCESHADE_HEADERS ${PROJECT_BINARY_DIR}/headers)
  file(MAKE_DIRECTORY ${FORCESHADE_HEADERS})
  # Boost's assertions name their headers: the library has the same bytes wherever it is built.
  add_compile_options(-ffile-prefix-map=${FORCESHADE_HEADERS}=headers)
  file(CREATE_LINK ${FORCESHADE_BOOST}/boost ${FORCESHADE_HEADERS}/boost SYMBOLIC)
  find_path(FORCESHADE_EIGEN Eigen3Config.cmake REQUIRED NO_CMAKE_FIND_ROOT_PATH PATHS /usr/share/eigen3/cmake)
  set(Eigen3_DIR ${FORCESHADE_EIGEN})
endif()
if(FORCESHADE_SUBJECT_FILES AND CMAKE_CROSSCOMPILING)
  find_path(FORCESHADE_TOML toml++/toml.h REQUIRED NO_CMAKE_FIND_ROOT_PATH PATHS /usr/include)
  file(CREATE_LINK ${FORCESHADE_TOML}/toml++ ${FORCESHADE_HEADERS}/toml++ SYMBOLIC)
  add_library(tomlplusplus::tomlplusplus INTERFACE IMPORTED)
  target_include_directories(tomlplusplus::tomlplusplus INTERFACE ${FORCESHADE_HEADERS})
elseif(FORCESHADE_SUBJECT_FILES)
  find_package(tomlplusplus REQUIRED)
endif()
