#include "base/result.hpp"

#include <stdexcept>

namespace fitgauge {

void throw_bad_result(const Error& error) {
  throw std::logic_error(std::string(id(error.code)) + ": " + error.message);
}

}  // namespace fitgauge
