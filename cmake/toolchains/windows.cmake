# 64-bit Windows, by Debian's g++-mingw-w64-x86-64-posix; programs run in wine where it is installed.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
# A program needs no DLL of the compiler's.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
# The fma of mingw-w64's C library loses bits, and without -mfma g++ calls it: a processor of 2013 or later is needed. Vectors of
# 32 bytes are not used, because g++ does not align the stack for them on Windows (GCC bug 54412).
set(CMAKE_CXX_FLAGS_INIT "-mfma -mprefer-vector-width=128 -mmove-max=128 -mstore-max=128 -DEIGEN_DONT_VECTORIZE")
find_program(WINE wine)
if(WINE)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${WINE})
endif()
