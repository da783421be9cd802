#include "nc/run/q_parameters.hpp"

#include "tables/tabfile/characters.hpp"

namespace fitgauge::interpreter {

QParameters::QParameters()
    : cells_(kFirstConstant, kUndefined), strings_(parameter_count(QSpace::Qs)) {}

std::optional<double> QParameters::number(QRef parameter) const {
  const double value = cells_[cell_of(parameter)];
  return interpreter::is_defined(value) ? std::optional(value) : std::nullopt;
}

NcResult<void> QParameters::set(QRef parameter, double value) {
  if (!std::isfinite(value))
    return nc_error("the value for {} is not a finite number", name(parameter));
  cells_[cell_of(parameter)] = value;
  return {};
}

void QParameters::set_q(std::uint16_t number, double value) { cells_[kFirstQ + number] = value; }

const std::string* QParameters::string(std::uint16_t number) const {
  return strings_[number] ? &*strings_[number] : nullptr;
}

NcResult<void> QParameters::set_string(std::uint16_t number, std::string value) {
  const std::size_t size = tabfile::count_characters(value);
  if (size > kLongestString) {
    return nc_error("QS{} cannot take {} characters; a string parameter holds {}", number, size,
                    kLongestString);
  }
  strings_[number] = std::move(value);
  return {};
}

void QParameters::undefine(QRef parameter) {
  if (parameter.is_string()) {
    strings_[parameter.number].reset();
  } else {
    cells_[cell_of(parameter)] = kUndefined;
  }
}

bool QParameters::is_defined(QRef parameter) const {
  return parameter.is_string() ? strings_[parameter.number].has_value()
                               : number(parameter).has_value();
}

std::vector<double> QParameters::save_locals(const LinkedProgram& program) const {
  const auto ql = cells_.begin() + kFirstQl;
  std::vector<double> saved(ql, ql + kLocals);
  const auto counters =
      cells_.begin() + static_cast<std::ptrdiff_t>(kFirstConstant + program.constants().size());
  saved.insert(saved.end(), counters, counters + program.counters());
  return saved;
}

void QParameters::enter(const LinkedProgram& program, std::span<const double> saved) {
  if (cells_.size() < program.cells()) cells_.resize(program.cells(), kUndefined);
  const auto ql = cells_.begin() + kFirstQl;
  const auto constants = std::copy(program.constants().begin(), program.constants().end(),
                                   cells_.begin() + kFirstConstant);
  if (saved.empty()) {
    std::fill_n(ql, kLocals, kUndefined);
    std::fill_n(constants, program.counters(), kUndefined);
  } else {
    std::copy_n(saved.begin(), kLocals, ql);
    std::copy(saved.begin() + kLocals, saved.end(), constants);
  }
}

std::vector<ParameterValue> QParameters::all() const {
  std::vector<ParameterValue> values;
  const auto add_numbers = [&](QSpace space) {
    for (std::uint16_t i = 0; i < parameter_count(space); ++i) {
      // Adding 0 makes the negative zero of COS 90 a plain one.
      if (const auto value = number({space, i})) values.push_back({{space, i}, *value + 0.0});
    }
  };
  add_numbers(QSpace::Q);
  add_numbers(QSpace::Qr);
  for (std::uint16_t i = 0; i < parameter_count(QSpace::Qs); ++i) {
    if (strings_[i]) values.push_back({{QSpace::Qs, i}, *strings_[i]});
  }
  add_numbers(QSpace::Ql);
  return values;
}

NcError undefined_error(QRef parameter) {
  return nc_error("parameter {} is undefined; assign it before this block reads it",
                  name(parameter));
}

}  // namespace fitgauge::interpreter
