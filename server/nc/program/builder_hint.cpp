#include "nc/program/builder_hint.hpp"

#include <fmt/format.h>

namespace fitgauge::interpreter {

std::string m_function_hint(int number) {
  return fmt::format(
      "M{0} is not available here; if the builder of the machine made it, say in the setup what it "
      R"(does: "m_functions":{{"{0}":"ignore"}}, or {{"call":"TNC:\\oem\\m{0}.h"}})",
      number);
}

std::string cycle_hint(bool is_probing, int number) {
  return fmt::format(
      "{0} {1} is not available here; if the builder of the machine made it, say in the setup what "
      R"(it does: "cycles":{{"{1}":"ignore"}}, or {{"call":"TNC:\\oem\\{1}.h"}})",
      is_probing ? "TCH PROBE" : "CYCL DEF", number);
}

}  // namespace fitgauge::interpreter
