// Preloaded into ParaView by `breccia live`: what it listens at is reached from this machine only. ParaView listens at
// all interfaces and has no option for it.

#include <arpa/inet.h>
#include <dlfcn.h>

#include <cstring>

namespace {

using Bind = int (*)(int, const sockaddr*, socklen_t);

bool is(const sockaddr* address, socklen_t length, sa_family_t family, std::size_t size) {
  return address != nullptr && address->sa_family == family && length >= size;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int bind(int socket, const sockaddr* address, socklen_t length) {
  static const auto next = reinterpret_cast<Bind>(::dlsym(RTLD_NEXT, "bind"));
  if (is(address, length, AF_INET, sizeof(sockaddr_in))) {
    sockaddr_in place{};
    std::memcpy(&place, address, sizeof place);
    if (place.sin_addr.s_addr == htonl(INADDR_ANY)) place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return next(socket, reinterpret_cast<const sockaddr*>(&place), sizeof place);
  }
  if (is(address, length, AF_INET6, sizeof(sockaddr_in6))) {
    sockaddr_in6 place{};
    std::memcpy(&place, address, sizeof place);
    if (IN6_IS_ADDR_UNSPECIFIED(&place.sin6_addr)) place.sin6_addr = in6addr_loopback;
    return next(socket, reinterpret_cast<const sockaddr*>(&place), sizeof place);
  }
  return next(socket, address, length);
}
