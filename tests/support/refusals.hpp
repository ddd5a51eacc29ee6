// How bad input is refused.
#pragma once

#include <cctype>
#include <optional>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "equipoise/core/base/error.hpp"

namespace equipoise {

/// Empty if `read` accepts its input.
template <class Read>
std::optional<InputError> refusal(Read&& read) {
  try {
    read();
  } catch (const InputError& e) {
    return e;
  }
  return std::nullopt;
}

/// The message is one line that begins with the place and names key, value and problem.
inline void expect_one_line(const InputError& error) {
  const std::string what = error.what();
  for (const char c : what) EXPECT_FALSE(std::iscntrl(static_cast<unsigned char>(c))) << what;
  EXPECT_EQ(what.find(error.where()), 0u) << what;
  EXPECT_NE(what.find(error.key()), std::string::npos) << what;
  EXPECT_NE(what.find(error.value()), std::string::npos) << what;
  EXPECT_FALSE(error.problem().empty());
  EXPECT_TRUE(what.ends_with(error.problem())) << what;  // nothing is cut off
}

/// The refusal's message; empty if `read` accepts its input.
template <class Read>
std::string refusal_text(Read&& read) {
  const auto error = refusal(read);
  return error ? error->what() : "";
}

/// The refusal's key.
template <class Read>
std::string refused_key(Read&& read) {
  const auto error = refusal(read);
  return error ? error->key() : "accepted";
}

template <class Read>
InputError refused(Read&& read) {
  const auto error = refusal(read);
  if (!error) throw std::logic_error("accepted");
  expect_one_line(*error);
  return *error;
}

}  // namespace equipoise
