#include <emscripten/emscripten.h>
#include <string>

#include "wasm/session.h"

// What JavaScript calls besides main(): the session of a page.

extern "C" {

/// The answer is valid until the next request.
EMSCRIPTEN_KEEPALIVE const char* cbc_session(const char* request);

const char* cbc_session(const char* request) {
  static cbc::play::Session session;
  static std::string answer;
  answer = session.answer(request);
  return answer.c_str();
}
}
