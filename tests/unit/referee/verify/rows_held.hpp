#pragma once

#include <gtest/gtest.h>

#include "inslab/referee/verify/table.hpp"

namespace inslab::verify {

/// The table itself is the message when a row missed its limit.
inline testing::AssertionResult every_row_held(const Table& table) {
  if (table.held()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\n" << to_text(table);
}

}  // namespace inslab::verify
