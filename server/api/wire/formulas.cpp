#include "api/wire/formulas.hpp"

#include "api/resources.hpp"

namespace fitgauge::api {
namespace {

constexpr std::array kFormulas = {
    Formula{"summary", "x̄ = Σx/n, s = √(Σ(x − x̄)²/(n − 1)), r(1) = Σ(xᵢ − x̄)(xᵢ₋₁ − x̄)/Σ(xᵢ − x̄)²",
            "NIST/SEMATECH e-Handbook, 1.3.5; quantiles: Hyndman and Fan 1996, type 7"},
    Formula{"stored_summary",
            "x̄ = Σx/n, s = √(Σ(x − x̄)²/(n − 1)), of the size at 20 °C where there is one",
            "NIST/SEMATECH e-Handbook, 1.3.5"},
    Formula{"anova_one_way", "F = (SSB/(k − 1))/(SSW/(n − k))",
            "NIST/SEMATECH e-Handbook, 1.3.5.4"},
    Formula{
        "capability",
        "Cp = (U − L)/6σ, Cpk = min(x̄ − L, U − x̄)/3σ; Pp, Ppk the same with s; "
        "Cpm = (U − L)/6√(s² + (x̄ − T)²), of one limit and a target |limit − T|/3√(s² + (x̄ − T)²)",
        "ISO 22514-2:2017; each interval names its own source"},
    Formula{
        "compensation",
        "level + wear by a Kalman filter, variances by maximum likelihood; dead band D³ = "
        "3c|β|h²/4 "
        "of wear β, D⁴ = 6cqh² of wandering q, c of a correction in parts, h half the tolerance",
        "NIST/SEMATECH e-Handbook 6.4.4; Del Castillo 2002, 1 and 5; Box and Luceño 1997"},
    Formula{"i_mr", "x̄ ± 3σ, σ = mean moving range/1.128", "ISO 7870-2"},
    Formula{"xbar_r", "x̿ ± 3σ/√n, σ = R̄/d₂", "ISO 7870-2"},
    Formula{"xbar_s", "x̿ ± 3σ/√n, σ = s̄/c₄", "ISO 7870-2"},
    Formula{"ewma", "z = λx + (1 − λ)z, x̿ ± 3σ√(λ/(2 − λ))", "ISO 7870-6:2016; Crowder 1987"},
    Formula{"cusum", "sums beyond kσ on each side, limits ± hσ", "ISO 7870-4:2021; Page 1954"},
    Formula{"type1",
            "Cg = 0.2T/6s, Cgk = (0.1T − |x̄ − reference|)/3s, or as tolerance_percent and spread",
            "Bosch Booklet 10 (2019), 4.1"},
    Formula{"measuring_system",
            "u_MS² = u_CAL² + max(u_EVR, u_RE)² + u_BI² + u_LIN² + u_MS,REST²; Q_MS = 2·2u_MS/T, "
            "C_MS = 0.3T/6u_MS",
            "ISO 22514-7:2012, 5.2, 7.1.2, 9 and A.3 to A.5; VDA 5"},
    Formula{
        "measuring_process",
        "u_MP² = u_CAL² + max(u_EVR, u_EVO, u_RE)² + the squares of the rest; Q_MP = 2·2u_MP/T, "
        "C_MP = 0.3T/3u_MP",
        "ISO 22514-7:2012, 5.2, 7.1, 9 and A.3 to A.5; VDA 5"},
    Formula{"anova",
            "EV² = MSₑ, INT² = (MSₚₒ − MSₑ)/r, AV² = (MSₒ − MSₚₒ)/pr, PV² = (MSₚ − MSₚₒ)/or; "
            "pooled: MSₚₒ and MSₑ are one",
            "AIAG MSA 4, III-B; ISO 22514-7:2021"},
    Formula{"average_range", "EV = R̄/d₂, AV = √((Δx̄/d₂*)² − EV²/pr), PV = Rₚ/d₂*",
            "AIAG MSA 4, III-B"},
    Formula{"nested", "EV² = MSₑ, PV² = (MSₚ − MSₑ)/r, AV² = (MSₒ − MSₚ)/pr",
            "AIAG MSA 4, IV; ISO 22514-7:2021"},
    Formula{"type3", "EV² = MSₑ, PV² = (MSₚ − MSₑ)/r", "AIAG MSA 4, III-B; ISO 22514-7:2021"},
    Formula{"linearity", "bias = a + b · reference by least squares, over all readings",
            "AIAG MSA 4, III-B"},
    Formula{"stability", "a chart of the readings of each time, Western Electric rules 1 to 4",
            "AIAG MSA 4, III-B; ISO 7870-2"},
    Formula{"attribute", "κ = (p₀ − pₑ)/(1 − pₑ), p₀ observed and pₑ chance agreement",
            "AIAG MSA 4, III-C; Cohen 1960, Fleiss 1971"},
    Formula{"pairing", "least Σ(clearance − target)² of all assignments",
            "no standard: an assignment of least squares"},
    Formula{"uncertainty", "u_c² = Σ(cᵢuᵢ)² + 2ΣΣcᵢcⱼuᵢuⱼrᵢⱼ, ν = u_c⁴/Σ((cᵢuᵢ)⁴/νᵢ), U = k u_c",
            "JCGM 100:2008, 5.1.2, 5.2.2, 6.2.1, G.4.1; Monte Carlo: JCGM 101:2008, 7"},
    Formula{"fit",
            "clearance = hole − shaft; P(interference) = Φ(−mean/√(σ_hole² + σ_shaft²)), "
            "normal with σ = T/6; uniform by convolution",
            "ISO 286-1:2010, 3.3; the probabilities are no part of it"},
    Formula{"press_fit",
            "p = U_w/(d[((D² + d²)/(D² − d²) + ν)/E + ((d² + d_i²)/(d² − d_i²) − ν_i)/E_i]), "
            "U_w = U − 0.4(Rz + Rz_i)",
            "DIN 7190-1:2017; Lamé's cylinders, elastic, plane stress"},
    Formula{"plug", "GO (Dmin + z) ± H/2, worn Dmin − y + α, NO-GO (Dmax − α) ± H/2",
            "ISO/R 1938:1971"},
    Formula{"ring or snap", "GO (dmax − z₁) ± H₁/2, worn dmax + y₁ − α₁, NO-GO (dmin + α₁) ± H₁/2",
            "ISO/R 1938:1971"},
};

}  // namespace

const Formula& formula_of(std::string_view of) {
  const auto found =
      std::ranges::find_if(kFormulas, [of](const Formula& formula) { return formula.of == of; });
  if (found == kFormulas.end()) throw std::logic_error("no formula of " + std::string(of));
  return *found;
}

void write_formula(JsonWriter& json, std::string_view of) {
  BodyWriter write(json);
  formula_members(write, of);
}

schema::Fields formula_fields() {
  BodySchema describe(Side::Answer);
  formula_members(describe, "summary");
  return describe.fields();
}

}  // namespace fitgauge::api
