// The functions of insitu_abi.h: no exception, no handler of a signal and no half-written text leaves them.

#include <algorithm>
#include <cstring>
#include <memory>

#include "catalyst/adaptor.hpp"
#include "catalyst/folders.hpp"
#include "catalyst/messages.hpp"
#include "catalyst/preflight.hpp"
#include "catalyst/replay.hpp"
#include "catalyst/signal_guard.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu {
namespace {

void put(const std::string& message, char* text, size_t size) {
  if (text == nullptr || size == 0) return;
  const std::size_t length = std::min(message.size(), size - 1);
  std::memcpy(text, message.data(), length);
  text[length] = '\0';
}

Adaptor& adaptor_of(void* pointer) { return *static_cast<Adaptor*>(pointer); }

std::int32_t preflight(const BrecciaConfig* config, char* text, size_t size) {
  const SignalGuard signals;
  put({}, text, size);
  try {
    std::string message;
    for (const std::string& problem : problems_of(*config))
      message += (message.empty() ? "" : "\n") + one_line(problem);
    put(message, text, size);
    return message.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    put(one_line(error.what()), text, size);
    return 1;
  }
}

void* open(const BrecciaConfig* config, char* text, size_t size) {
  const SignalGuard signals;
  put({}, text, size);
  try {
    return new Adaptor(*config);
  } catch (const std::exception& error) {
    put(one_line(error.what()), text, size);
    return nullptr;
  }
}

std::uint32_t channels(void* adaptor, std::int32_t pipeline, std::int64_t step, double time) {
  const SignalGuard signals;
  try {
    return adaptor_of(adaptor).channels(pipeline, step, time);
  } catch (const std::exception&) {
    return 0;
  }
}

std::int64_t execute(void* adaptor, std::uint32_t pipelines, const BrecciaInstant* instant, BrecciaRequests* requests,
                     char* text, size_t size) {
  const SignalGuard signals;
  put({}, text, size);
  *requests = {};
  try {
    std::string message;
    const std::uint32_t failed = adaptor_of(adaptor).execute(pipelines, *instant, *requests, message);
    if (!message.empty()) message.pop_back();  // no newline at the end
    put(message, text, size);
    return failed;
  } catch (const Abandoned& wait) {
    put(one_line(wait.what()), text, size);
    return -1;
  } catch (const std::exception& error) {
    put(one_line(error.what()), text, size);
    return pipelines;
  }
}

void notices(void* adaptor, char* text, size_t size) {
  put({}, text, size);
  try {
    put(adaptor_of(adaptor).notices(), text, size);
  } catch (const std::exception&) {
    // There is nothing to tell.
  }
}

std::int64_t bytes_written(void* adaptor, std::int32_t pipeline) {
  try {
    return adaptor_of(adaptor).bytes_written(pipeline);
  } catch (const std::exception&) {
    return 0;
  }
}

void close(void* adaptor, char* text, size_t size) {
  const SignalGuard signals;
  put({}, text, size);
  try {
    const std::unique_ptr<Adaptor> owned(static_cast<Adaptor*>(adaptor));
    put(owned->finish(), text, size);
  } catch (const std::exception&) {
    // Nothing is left to do with what has failed to end.
  }
}

std::int32_t replay_records(const BrecciaConfig* config, const char* folder, char* text, size_t size) {
  const SignalGuard signals;
  put({}, text, size);
  try {
    Adaptor adaptor(*config);
    replay(adaptor, folder);
    put(adaptor.finish(), text, size);
    return 0;
  } catch (const std::exception& error) {
    put(one_line(error.what()), text, size);
    return 1;
  }
}

}  // namespace
}  // namespace breccia::insitu

extern "C" __attribute__((visibility("default"))) const BrecciaInsituApi* breccia_insitu_api(void) {
  using namespace breccia::insitu;
  static const std::string folder = data_folder().string();
  static const BrecciaInsituApi api{BRECCIA_INSITU_ABI_VERSION,
                                    backend_description(),
                                    folder.c_str(),
                                    preflight,
                                    open,
                                    channels,
                                    execute,
                                    notices,
                                    bytes_written,
                                    close,
                                    replay_records};
  return &api;
}
