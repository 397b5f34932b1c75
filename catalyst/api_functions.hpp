#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include "catalyst/folders.hpp"
#include "catalyst/insitu_abi.h"
#include "catalyst/pipeline_error.hpp"
#include "catalyst/signal_guard.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu {

inline void put(const std::string& message, char* text, size_t size) {
  if (text == nullptr || size == 0) return;
  const std::size_t length = std::min(message.size(), size - 1);
  std::memcpy(text, message.data(), length);
  text[length] = '\0';
}

/// The functions of insitu_abi.h over a back end, with: Adaptor (channels, execute, notices, bytes_written, finish),
/// problems_of(config), found() (PipelineError: nothing usable), replay(adaptor, folder), description().
/// No exception, no handler of a signal and no half-written text leaves them.
template <class Backend>
class ApiFunctions {
 public:
  [[nodiscard]] static const BrecciaInsituApi* api() {
    static const std::string folder = data_folder().string();
    static const BrecciaInsituApi functions{BRECCIA_INSITU_ABI_VERSION,
                                            Backend::description(),
                                            folder.c_str(),
                                            find,
                                            preflight,
                                            open,
                                            channels,
                                            execute,
                                            notices,
                                            bytes_written,
                                            close,
                                            replay};
    return &functions;
  }

 private:
  using Adaptor = typename Backend::Adaptor;
  static Adaptor& adaptor_of(void* pointer) { return *static_cast<Adaptor*>(pointer); }

  /// 0, with what call() returns as the text, or 1 with what it throws.
  template <class Call>
  static std::int32_t answer(char* text, size_t size, Call&& call) {
    const SignalGuard signals;
    put({}, text, size);
    try {
      put(call(), text, size);
      return 0;
    } catch (const std::exception& error) {
      put(one_line(error.what()), text, size);
      return 1;
    }
  }

  static std::int32_t find(char* text, size_t size) {
    return answer(text, size, [&] { return Backend::found(); });
  }

  static std::int32_t preflight(const BrecciaConfig* config, char* text, size_t size) {
    bool good = true;
    const std::int32_t failed = answer(text, size, [&] {
      std::string message;
      for (const std::string& problem : Backend::problems_of(*config))
        message += (message.empty() ? "" : "\n") + one_line(problem);
      good = message.empty();
      return message;
    });
    return failed == 0 && good ? 0 : 1;
  }

  static void* open(const BrecciaConfig* config, char* text, size_t size) {
    Adaptor* adaptor = nullptr;
    answer(text, size, [&] {
      adaptor = new Adaptor(*config);
      return std::string();
    });
    return adaptor;
  }

  static std::uint32_t channels(void* adaptor, std::int32_t pipeline, std::int64_t step, double time) {
    const SignalGuard signals;
    try {
      return adaptor_of(adaptor).channels(pipeline, step, time);
    } catch (const std::exception&) {
      return 0;
    }
  }

  static std::int64_t execute(void* adaptor, std::uint32_t pipelines, const BrecciaInstant* instant,
                              BrecciaRequests* requests, char* text, size_t size) {
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

  static void notices(void* adaptor, char* text, size_t size) {
    put({}, text, size);
    try {
      put(adaptor_of(adaptor).notices(), text, size);
    } catch (const std::exception&) {
      // There is no message.
    }
  }

  static std::int64_t bytes_written(void* adaptor, std::int32_t pipeline) {
    try {
      return adaptor_of(adaptor).bytes_written(pipeline);
    } catch (const std::exception&) {
      return 0;
    }
  }

  static void close(void* adaptor, char* text, size_t size) {
    const SignalGuard signals;
    put({}, text, size);
    try {
      const std::unique_ptr<Adaptor> owned(static_cast<Adaptor*>(adaptor));
      put(owned->finish(), text, size);
    } catch (const std::exception&) {
      // Nothing is left to do with what has failed to end.
    }
  }

  static std::int32_t replay(const BrecciaConfig* config, const char* folder, char* text, size_t size) {
    return answer(text, size, [&] { return Backend::replay(*config, folder); });
  }
};

}  // namespace breccia::insitu
