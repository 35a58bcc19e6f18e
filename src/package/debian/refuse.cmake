# CPack reads it first.
message(FATAL_ERROR "the Debian package is for builds with BUILD_SHARED_LIBS=OFF and CBC_STATIC=OFF")
