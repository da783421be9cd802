#pragma once

#include <stdexcept>
#include <utility>

#include "base/error.hpp"

namespace fitgauge::store {

/// Broken storage: a full or failing disk, a damaged page. Caught at the border of the writer and
/// of the read pool, where it becomes its Error.
class StorageFailure : public std::runtime_error {
 public:
  explicit StorageFailure(Error error)
      : std::runtime_error(error.message), error_(std::move(error)) {}

  const Error& error() const { return error_; }

 private:
  Error error_;
};

}  // namespace fitgauge::store
