#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace breccia::case_ {

/// Default address at which ParaView listens.
inline constexpr const char* live_address = "localhost:22222";

/// "host:port" or "port", an IPv6 host in brackets; nothing if it is neither.
[[nodiscard]] std::optional<std::pair<std::string, int>> host_and_port(std::string_view address);

/// True for names of the machine itself: localhost, an address 127.x.x.x, ::1. A name that only begins so is none.
[[nodiscard]] bool is_loopback(std::string_view host);

}  // namespace breccia::case_
