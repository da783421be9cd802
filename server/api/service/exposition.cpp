#include "api/service/exposition.hpp"

#include <charconv>
#include <cmath>
#include <iterator>

namespace fitgauge::api {
namespace {

void append_number(std::string& out, double value) {
  if (std::isinf(value)) {
    out += value > 0 ? "+Inf" : "-Inf";
    return;
  }
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
  out.append(std::begin(digits), end);
}

void append_label(std::string& out, std::string_view name, std::string_view value) {
  out += out.back() == '{' ? "" : ",";
  out.append(name) += "=\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') {
      out += "\\n";
    } else {
      out += c;
    }
  }
  out += '"';
}

}  // namespace

Exposition& Exposition::counter(std::string_view name, std::string_view help) {
  return family(name, help, "counter");
}
Exposition& Exposition::gauge(std::string_view name, std::string_view help) {
  return family(name, help, "gauge");
}
Exposition& Exposition::histogram(std::string_view name, std::string_view help) {
  return family(name, help, "histogram");
}

Exposition& Exposition::family(std::string_view name, std::string_view help,
                               std::string_view type) {
  family_ = name;
  out_.append("# HELP ").append(name).append(" ").append(help).append("\n");
  out_.append("# TYPE ").append(name).append(" ").append(type).append("\n");
  return *this;
}

Exposition& Exposition::sample(double value, Labels labels) {
  line("", labels, {}, value);
  return *this;
}

void Exposition::line(std::string_view suffix, Labels labels, std::optional<double> bound,
                      double value) {
  out_.append(family_).append(suffix);
  if (labels.size() > 0 || bound) {
    out_ += '{';
    for (const auto& [name, text] : labels) append_label(out_, name, text);
    if (bound) {
      std::string text;
      append_number(text, *bound);
      append_label(out_, "le", text);
    }
    out_ += '}';
  }
  out_ += ' ';
  append_number(out_, value);
  out_ += '\n';
}

}  // namespace fitgauge::api
