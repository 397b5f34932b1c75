#include "base/log.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/dist_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <memory>
#include <string>

#include "base/error.hpp"

namespace breccia::log {
namespace {

spdlog::level::level_enum native(Level level) {
  switch (level) {
    case Level::info:
      return spdlog::level::info;
    case Level::warning:
      return spdlog::level::warn;
    case Level::error:
      break;
  }
  return spdlog::level::err;
}

/// stderr always, a file once opened; spdlog's dist_sink lets the file change while other threads write.
struct Channels {
  std::shared_ptr<spdlog::sinks::dist_sink_mt> all = std::make_shared<spdlog::sinks::dist_sink_mt>();
  std::shared_ptr<spdlog::sinks::sink> terminal = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  std::shared_ptr<spdlog::sinks::sink> file;
  spdlog::logger logger{"breccia", all};

  Channels() {
    terminal->set_pattern("%l: %v");
    all->add_sink(terminal);
    logger.set_level(spdlog::level::info);
    logger.flush_on(spdlog::level::info);
  }
};

Channels& channels() {
  static Channels instance;
  return instance;
}

void write(Level level, std::string_view message) {
  channels().logger.log(native(level), spdlog::string_view_t(message.data(), message.size()));
}

}  // namespace

void set_level(Level level) { channels().logger.set_level(native(level)); }

void open_file(const std::filesystem::path& file) {
  std::shared_ptr<spdlog::sinks::sink> next;
  try {
    next = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), true);
  } catch (const spdlog::spdlog_ex& failure) {
    throw OutputError(
        Problem{file.string(), 0, "", std::string("the log cannot be written: ") + failure.what(), "", ""});
  }
  next->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
  Channels& c = channels();
  if (c.file) c.all->remove_sink(c.file);
  c.file = std::move(next);
  c.all->add_sink(c.file);
}

void info(std::string_view message) { write(Level::info, message); }
void warning(std::string_view message) { write(Level::warning, message); }
void error(std::string_view message) { write(Level::error, message); }

}  // namespace breccia::log
