#include "record/record_text.hpp"

namespace fitgauge::app {

RecordText& RecordText::escaped(std::string_view text) {
  char* at = at_;
  for (const char c : text) {
    if (needs_escape(c)) {
      at = write_escape(at, c);
    } else {
      *at++ = c;
    }
  }
  at_ = at;
  return *this;
}

}  // namespace fitgauge::app
