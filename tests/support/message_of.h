// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <string>

namespace lmdbench::testing {

/// Message of the error that `action` throws; an empty text when it throws nothing.
template <typename ErrorType, typename Action>
std::string complaint_of(const Action& action) {
  try {
    action();
  } catch (const ErrorType& error) {
    return error.what();
  }
  return {};
}

/// The same; a test failure and an empty text when it throws none of that type.
template <typename ErrorType, typename Action>
std::string message_of(const Action& action) {
  try {
    const std::string message = complaint_of<ErrorType>(action);
    EXPECT_NE(message, "") << "no error";
    return message;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another error: " << error.what();
    return {};
  }
}

}  // namespace lmdbench::testing
