#include "case/live_address.hpp"

#include <arpa/inet.h>

#include <charconv>

namespace breccia::case_ {

std::optional<std::pair<std::string, int>> host_and_port(std::string_view address) {
  const std::size_t colon = address.rfind(':');
  std::string_view host = colon == std::string_view::npos ? "localhost" : address.substr(0, colon);
  const std::string_view digits = colon == std::string_view::npos ? address : address.substr(colon + 1);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  int port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  const bool whole = error == std::errc() && end == digits.data() + digits.size();
  if (!whole || port < 1 || port > 65535 || host.empty()) return {};
  return std::pair(std::string(host), port);
}

bool is_loopback(std::string_view host) {
  in_addr address{};
  if (::inet_pton(AF_INET, std::string(host).c_str(), &address) == 1) return (ntohl(address.s_addr) >> 24) == 127;
  return host == "localhost" || host == "::1";
}

}  // namespace breccia::case_
