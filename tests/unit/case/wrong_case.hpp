#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "case_files.hpp"

namespace breccia::case_ {

/// A change that makes the complete case wrong, and what the message must say.
struct Wrong {
  const char* name;
  const char* from;
  const char* to;
  std::vector<const char*> says;
};

/// One change is one fault: a second message would lead the user astray.
inline void expect_one_message(const Wrong& wrong) {
  const std::string message = message_of(replaced(complete, wrong.from, wrong.to));
  for (const char* part : wrong.says) EXPECT_THAT(message, testing::HasSubstr(part));
  EXPECT_THAT(message, testing::HasSubstr("case.toml:"));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
}

}  // namespace breccia::case_
