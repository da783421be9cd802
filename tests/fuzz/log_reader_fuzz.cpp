// Bytes as a file of a control, and, up to a first NUL, as a pattern for the rest: every value has
// a measured text, limits come in pairs around it in order, and the text of a log reads as itself.

#include "formats/measuring_log/measuring_log.hpp"
#include "target.hpp"

using namespace fitgauge::log_reader;

void take(std::string_view bytes) {
  for (const auto& read : {&read_logs, &read_text_logs, &read_html_logs}) {
    const Reading reading = read(bytes);
    for (const MeasuringLog& log : reading.logs) {
      require(log.cycle > 0 && !log.values.empty());
      for (const LogValue& value : log.values) {
        require(value.upper.has_value() == value.lower.has_value());
        require(!value.upper || (value.nominal && value.is_length));
      }
    }
  }
  for (const MeasuringLog& log : read_text_logs(bytes).logs) {
    const Reading again = read_text_logs(log.text);
    require(again.logs.size() == 1 && again.logs[0].values.size() == log.values.size());
  }
  const std::size_t end = bytes.find('\0');
  if (end == std::string_view::npos) return;
  const auto pattern = Pattern::parse(bytes.substr(0, end));
  if (!pattern) return;
  for (const PatternResult& result : pattern->read(bytes.substr(end + 1)).results) {
    require(result.fields.contains("measured_mm") && !result.text.empty());
  }
}
