#include "nc/run/nc_error.hpp"

#include "nc/program/diagnose.hpp"

namespace fitgauge::interpreter {

NcError nc_error(std::string text) { return {NcErrorKind::Error, 0, std::move(text)}; }

NcError nc_error(int number, std::string_view detail) {
  return from_cycle(probing::nc_error(number, detail));
}

NcError limit_error(std::string text) { return {NcErrorKind::Limit, 0, std::move(text)}; }

NcError from_machine(const machine::MachineFault& fault) {
  return {NcErrorKind::Error, fault.number, fault.text};
}

NcError from_cycle(const probing::CycleFault& fault) {
  const bool stop = fault.kind == probing::CycleFaultKind::ToleranceStop;
  return {stop ? NcErrorKind::Stop : NcErrorKind::Error, fault.number, fault.text};
}

NcError from_error(const Error& error) {
  return nc_error(error.where.empty() ? error.message : error.where + ": " + error.message);
}

void throw_bad_nc_result(const NcError& error) {
  throw std::logic_error("value of a failed NC result was read: " + error.text);
}

NcError unknown_m_function(int number) { return nc_error(m_function_hint(number)); }

NcError unknown_cycle(bool is_probing, int number) {
  return nc_error(cycle_hint(is_probing, number));
}

}  // namespace fitgauge::interpreter
