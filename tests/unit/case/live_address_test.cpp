#include "case/live_address.hpp"

#include <gtest/gtest.h>

namespace breccia::case_::live_address_test {
namespace {

TEST(LiveAddress, OfThisMachineIsKnownByItsNumberNotByItsBeginning) {
  for (const char* host : {"localhost", "127.0.0.1", "127.1.2.3", "::1"}) EXPECT_TRUE(is_loopback(host)) << host;
  for (const char* host : {"127.evil.example", "127.0.0.1.evil.example", "128.0.0.1", "192.168.0.7", "1.2.3.4", "",
                           "localhost.example", "126.0.0.1"})
    EXPECT_FALSE(is_loopback(host)) << host;
}

}  // namespace
}  // namespace breccia::case_::live_address_test
