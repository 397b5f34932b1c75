#include "catalyst/link_watch.hpp"

#include <arpa/inet.h>

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <string>
#include <utility>

namespace breccia::insitu {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(100);

/// Descriptors of this process that are sockets of TCP.
std::set<int> tcp_sockets() {
  std::set<int> found;
  std::error_code error;
  for (auto entry = std::filesystem::directory_iterator("/proc/self/fd", error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename();
    int descriptor = -1, type = 0, family = 0;
    std::from_chars(name.data(), name.data() + name.size(), descriptor);
    socklen_t size = sizeof type;
    if (::getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_STREAM) continue;
    size = sizeof family;
    if (::getsockopt(descriptor, SOL_SOCKET, SO_DOMAIN, &family, &size) != 0 || family != AF_INET) continue;
    found.insert(descriptor);
  }
  return found;
}

/// Ends what goes to the port, and what has begun since and goes nowhere yet.
void shut_down(int port, const std::set<int>& before) {
  for (const int descriptor : tcp_sockets()) {
    sockaddr_in peer{};
    socklen_t size = sizeof peer;
    const bool connected = ::getpeername(descriptor, reinterpret_cast<sockaddr*>(&peer), &size) == 0;
    int listens = 0;
    size = sizeof listens;
    static_cast<void>(::getsockopt(descriptor, SOL_SOCKET, SO_ACCEPTCONN, &listens, &size));
    const bool connects = !connected && listens == 0 && !before.contains(descriptor);
    if (connects || (connected && ntohs(peer.sin_port) == port)) ::shutdown(descriptor, SHUT_RDWR);
  }
}

}  // namespace

LinkWatch::LinkWatch(int port, std::function<bool()> run_ends)
    : port_(port), run_ends_(std::move(run_ends)), thread_(kPollInterval, [this] { look(); }) {}

void LinkWatch::begin(std::optional<std::chrono::milliseconds> limit) {
  std::set<int> before = tcp_sockets();
  thread_.begin([&] {
    before_ = std::move(before);
    deadline_.reset();
    stopped_before_ = thread_.stopped();
    if (limit) deadline_ = std::chrono::steady_clock::now() + *limit;
    cut_ = false;
  });
}

bool LinkWatch::end() {
  bool cut = false;
  thread_.end([&] { cut = cut_; });
  return cut;
}

void LinkWatch::look() {
  const auto stopped = thread_.stopped() - stopped_before_;
  const bool late = deadline_ && std::chrono::steady_clock::now() - stopped > *deadline_;
  if (!late && !cut_ && !(!deadline_ && run_ends_())) return;
  cut_ = true;
  shut_down(port_, before_);
}

}  // namespace breccia::insitu
