# Toolchain of a cross build with Debian's g++-aarch64-linux-gnu: cmake --preset runtime --toolchain deploy/cmake/aarch64-linux-gnu.cmake
# SEMBLANTE_SYSROOT: a folder with Debian's packages for arm64 (deploy/lib/arm64_packages.sh --dependencies), for programs
# that need more libraries than the compiler brings.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
if(SEMBLANTE_SYSROOT)
  set(CMAKE_SYSROOT ${SEMBLANTE_SYSROOT})
  set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
  list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES SEMBLANTE_SYSROOT)
  set(ENV{PKG_CONFIG_SYSROOT_DIR} ${SEMBLANTE_SYSROOT})
  set(ENV{PKG_CONFIG_LIBDIR} ${SEMBLANTE_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${SEMBLANTE_SYSROOT}/usr/share/pkgconfig)
endif()
