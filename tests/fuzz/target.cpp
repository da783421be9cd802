#include "target.hpp"

/// The entry function of libFuzzer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  take({reinterpret_cast<const char*>(data), size});
  return 0;
}
