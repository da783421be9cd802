#pragma once

namespace fitgauge::metrology {

/// Components of the uncertainty of a measuring process (ISO 22514-7; VDA 5). The first ones, up to
/// MsRest, belong to the measuring system.
enum class Component : std::uint8_t {  // clang-format off
  Cal, Re, Bi, Lin, Evr, MsRest, Evo, Av, Ia, Gv, Stab, T, Obj, MpRest };  // clang-format on

/// The source of a component: a `Master` study, a study of `Parts`, or neither.
enum class ComponentOf : std::uint8_t { Given, Master, Parts };
struct ComponentRow {
  std::string_view name;
  ComponentOf of;
  std::string_view meaning;
};
inline constexpr std::array<ComponentRow, 14> kComponents = {{
    {"u_cal", ComponentOf::Given, "Calibration of the master, U/k of its certificate"},
    {"u_re", ComponentOf::Master, "Resolution/√12"},
    {"u_bi", ComponentOf::Master, "Bias on the master/√3"},
    {"u_lin", ComponentOf::Given, "Linearity"},
    {"u_evr", ComponentOf::Master, "Repeatability on the master"},
    {"u_ms_rest", ComponentOf::Given, "Other contributions of the measuring system"},
    {"u_evo", ComponentOf::Parts, "Repeatability on parts"},
    {"u_av", ComponentOf::Parts, "Operators"},
    {"u_ia", ComponentOf::Parts, "Interaction of part and operator"},
    {"u_gv", ComponentOf::Given, "Gauges of one kind"},
    {"u_stab", ComponentOf::Given, "Stability over time"},
    {"u_t", ComponentOf::Given, "Temperature"},
    {"u_obj", ComponentOf::Given, "Form of the part"},
    {"u_mp_rest", ComponentOf::Given, "Other contributions of the measuring process"},
}};

/// Standard uncertainties in the unit of the readings; absent: no part of it.
struct MeasuringProcess {
  std::array<std::optional<double>, kComponents.size()> components{};

  std::optional<double>& operator[](Component of) {
    return components.at(static_cast<std::size_t>(of));
  }
  const std::optional<double>& operator[](Component of) const {
    return components.at(static_cast<std::size_t>(of));
  }
  /// u_MS and u_MP: the root of the sum of squares. Only the largest of u_EVR and u_RE, for the
  /// process of u_EVR, u_EVO and u_RE, counts (ISO 22514-7:2012, A.3).
  double system() const { return combined(Component::MsRest); }
  double process() const { return combined(Component::MpRest); }

 private:
  double combined(Component last) const {
    double variance = 0, repeatability = 0;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(last); ++i) {
      const double u = components.at(i).value_or(0);
      const auto of = static_cast<Component>(i);
      const bool repeats = of == Component::Re || of == Component::Evr || of == Component::Evo;
      repeats ? repeatability = std::max(repeatability, u) : variance += u * u;
    }
    return std::sqrt(variance + repeatability * repeatability);
  }
};

/// Capability of a standard uncertainty u of a system or a process (ISO 22514-7, clause 9).
struct MeasuringCapability {
  MeasuringCapability(double u, double tolerance, bool is_process)
      : percent(400 * u / tolerance),
        index(0.3 * tolerance / ((is_process ? 3 : 6) * u)),
        least_tolerance(4 * u / (is_process ? 0.30 : 0.15)) {}

  double percent;          ///< Q: 2 k u/T with k = 2
  double index;            ///< C: 0.3 T/(6 u), of a process 0.3 T/(3 u)
  double least_tolerance;  ///< with Q of 15 %, of a process of 30 %
};

}  // namespace fitgauge::metrology
