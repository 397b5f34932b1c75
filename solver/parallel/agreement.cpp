#include <cstring>
#include <filesystem>
#include <new>
#include <optional>

#include "base/error.hpp"
#include "parallel/communicator.hpp"

/// The part of Communicator that makes an error on one rank an error on all.
namespace breccia {
namespace {

enum class Kind : std::int64_t { input, output, simulation, internal };

struct Failure {
  Kind kind;
  std::vector<Problem> problems;  ///< of InputError and OutputError
  std::string text;               ///< of the others
};

void put(std::vector<std::byte>& bytes, std::int64_t number) {
  const auto raw = std::as_bytes(std::span(&number, 1));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

void put(std::vector<std::byte>& bytes, const std::string& text) {
  put(bytes, static_cast<std::int64_t>(text.size()));
  const auto raw = std::as_bytes(std::span(text));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::int64_t number() {
    std::int64_t value = 0;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    return value;
  }
  std::string text() {
    const auto length = static_cast<std::size_t>(number());
    std::string value(reinterpret_cast<const char*>(bytes_.data()), length);
    bytes_ = bytes_.subspan(length);
    return value;
  }

 private:
  std::span<const std::byte> bytes_;
};

std::vector<std::byte> packed(const Failure& failure) {
  std::vector<std::byte> bytes;
  put(bytes, static_cast<std::int64_t>(failure.kind));
  put(bytes, failure.text);
  put(bytes, static_cast<std::int64_t>(failure.problems.size()));
  for (const Problem& p : failure.problems) {
    put(bytes, std::int64_t{p.line});
    for (const std::string* part : {&p.file, &p.key, &p.what, &p.allowed, &p.given}) put(bytes, *part);
  }
  return bytes;
}

Failure unpacked(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  Failure failure{static_cast<Kind>(reader.number()), {}, reader.text()};
  for (std::int64_t left = reader.number(); left > 0; --left) {
    Problem p;
    p.line = static_cast<int>(reader.number());
    for (std::string* part : {&p.file, &p.key, &p.what, &p.allowed, &p.given}) *part = reader.text();
    failure.problems.push_back(std::move(p));
  }
  return failure;
}

[[noreturn]] void raise(Failure failure) {
  switch (failure.kind) {
    case Kind::input:
      throw InputError(std::move(failure.problems));
    case Kind::output:
      throw OutputError(std::move(failure.problems));
    case Kind::simulation:
      throw SimulationError(std::move(failure.text));
    case Kind::internal:
      break;
  }
  throw InternalError(std::move(failure.text));
}

std::optional<Failure> failure_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const OutputError& error) {
    return Failure{Kind::output, error.problems(), {}};
  } catch (const InputError& error) {
    return Failure{Kind::input, error.problems(), {}};
  } catch (const SimulationError& error) {
    return Failure{Kind::simulation, {}, error.what()};
  } catch (const std::bad_alloc&) {
    return Failure{Kind::input, {out_of_memory()}, {}};
  } catch (const std::filesystem::filesystem_error& error) {
    return Failure{Kind::output, {Problem{"", 0, "", error.what(), "", ""}}, {}};
  } catch (const std::exception& error) {
    return Failure{Kind::internal, {}, error.what()};
  } catch (...) {
    return Failure{Kind::internal, {}, "an exception without a text"};
  }
  return std::nullopt;
}

}  // namespace

void Communicator::agree(const std::function<void()>& work) const {
  if (size() == 1) return work();
  const std::optional<Failure> failure = failure_of(work);
  // The larger, the lower the rank that failed; 0: none.
  const std::int64_t lowest = max(failure ? std::int64_t{size()} - rank() : std::int64_t{0});
  if (lowest == 0) return;
  const bool reports = lowest == size() - rank();
  const std::vector<std::byte> mine = reports ? packed(*failure) : std::vector<std::byte>{};
  for (const std::vector<std::byte>& bytes : all_gather_bytes(mine)) {
    if (!bytes.empty()) raise(unpacked(bytes));
  }
}

}  // namespace breccia
