// What belongs to the process or a thread: version, error text, callbacks.
#include "radiosity/c_api/handles.h"

#include <cstring>

#define HC_TEXT_OF(number) #number
#define HC_TEXT(number) HC_TEXT_OF(number)

namespace hemicube::radiosity::c_api {
namespace {

#if defined(HC_NO_THREADS)
char g_error_text[Status::kCapacity];
#else
thread_local char g_error_text[Status::kCapacity];
#endif

int code_of(StatusCode code) noexcept {
  switch (code) {
  case StatusCode::kOk:
    return HC_OK;
  case StatusCode::kBadScene:
    return HC_BAD_SCENE;
  case StatusCode::kOutOfMemory:
    return HC_OUT_OF_MEMORY;
  case StatusCode::kNotConverged:
    return HC_NOT_CONVERGED;
  case StatusCode::kSingular:
    return HC_SINGULAR;
  case StatusCode::kCancelled:
    return HC_CANCELLED;
  case StatusCode::kUnsupportedFloatEnvironment:
    return HC_BAD_FLOAT_ENVIRONMENT;
  case StatusCode::kIo:          // there are no files
  case StatusCode::kCheckFailed: // and no conditions
  case StatusCode::kInvalidArgument:
    break;
  }
  return HC_INVALID_ARGUMENT;
}

// The caller's callbacks have a context, those of the core have none.
hc_allocator g_allocator;
void (*g_log)(void* context, const char* message);
void* g_log_context;
void (*g_assert)(void* context, const char* expression, const char* file, int line);
void* g_assert_context;

void* allocate(std::size_t bytes) {
  return g_allocator.allocate(g_allocator.context, bytes);
}
void release(void* memory, std::size_t bytes) {
  g_allocator.release(g_allocator.context, memory, bytes);
}
void tell(const char* message) {
  g_log(g_log_context, message);
}
void assertion(const char* expression, const char* file, int line) {
  g_assert(g_assert_context, expression, file, line);
}

Status change_allocator(const hc_allocator* allocator) noexcept {
  hc_allocator read = {};
  if (allocator != nullptr) {
    HC_TRY(read_struct("allocator", allocator, sizeof(hc_allocator), &read));
    if (read.allocate == nullptr || read.release == nullptr)
      return null_argument("allocate or release of the allocator");
  }
  if (g_handle_count != 0)
    return Status::error(StatusCode::kInvalidArgument, "the allocator cannot be changed while ",
                         "there are handles: ", g_handle_count.load());
  g_allocator = read;
  set_allocator(allocator != nullptr ? Allocator{allocate, release} : default_allocator());
  return {};
}

} // namespace

int finish(const Status& status) noexcept {
  if (!status.ok())
    std::memcpy(g_error_text, status.message().data(), status.message().size() + 1);
  return code_of(status.code());
}

Status null_argument(const char* name) noexcept {
  return Status::error(StatusCode::kInvalidArgument, name, " is NULL");
}

} // namespace hemicube::radiosity::c_api

using namespace hemicube;
using namespace hemicube::radiosity::c_api;

const char* hc_version(void) {
  return HC_TEXT(HC_VERSION_MAJOR) "." HC_TEXT(HC_VERSION_MINOR) "." HC_TEXT(HC_VERSION_PATCH);
}

const char* hc_error_text(void) {
  return g_error_text;
}

int hc_set_allocator(const hc_allocator* allocator) {
  return finish(change_allocator(allocator));
}

int hc_set_log(void (*callback)(void* context, const char* message), void* context) {
  g_log = callback;
  g_log_context = context;
  set_log_handler(callback != nullptr ? tell : nullptr);
  return HC_OK;
}

int hc_set_assert(void (*failed)(void* context, const char* expression, const char* file, int line),
                  void* context) {
  g_assert = failed;
  g_assert_context = context;
  set_assert_handler(failed != nullptr ? assertion : nullptr);
  return HC_OK;
}
