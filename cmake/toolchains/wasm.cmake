# WebAssembly, by Debian's emscripten; programs run in node. The instructions are those of the standard: SIMD of 128 bits and no
# relaxed SIMD, whose results may differ from one processor to another.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
# The folder of Debian with the modules of node that emscripten's linker needs.
set(CMAKE_C_LINKER_LAUNCHER env NODE_PATH=/usr/share/nodejs)
set(CMAKE_CXX_LINKER_LAUNCHER env NODE_PATH=/usr/share/nodejs)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fexceptions -include ${CMAKE_CURRENT_LIST_DIR}/wasm/library.h")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-fexceptions -sALLOW_MEMORY_GROWTH=1 -sINITIAL_MEMORY=32MB -sTOTAL_STACK=4MB")
# Programs are given files of this machine; later versions of node have a fetch() that emscripten 3.1.6 takes for a browser's.
find_program(NODE node)
if(NODE)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${NODE} --no-experimental-fetch)
endif()
