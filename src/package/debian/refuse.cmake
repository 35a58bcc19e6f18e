# CPack reads this file first.
message(FATAL_ERROR "the Debian package needs a build with BUILD_SHARED_LIBS=OFF and CBC_STATIC=OFF")
