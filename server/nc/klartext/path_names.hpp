#pragma once

#include <string_view>

#include "nc/klartext/statement.hpp"

/// How positioning blocks are spelled; the parser and the printer share it.
namespace fitgauge::klartext {

struct PathName {
  Path path;
  std::string_view name;
};

/// In the order of Path. APPR and DEP: by their second word; a paraxial block has no name.
inline constexpr PathName kPaths[] = {
    {Path::L, "L"},
    {Path::Lp, "LP"},
    {Path::Ln, "LN"},
    {Path::Cc, "CC"},
    {Path::C, "C"},
    {Path::Cp, "CP"},
    {Path::Cr, "CR"},
    {Path::Ct, "CT"},
    {Path::Ctp, "CTP"},
    {Path::Rnd, "RND"},
    {Path::Chf, "CHF"},
    {Path::ApprLt, "APPR LT"},
    {Path::ApprLn, "APPR LN"},
    {Path::ApprCt, "APPR CT"},
    {Path::ApprLct, "APPR LCT"},
    {Path::ApprPlt, "APPR PLT"},
    {Path::ApprPln, "APPR PLN"},
    {Path::ApprPct, "APPR PCT"},
    {Path::ApprPlct, "APPR PLCT"},
    {Path::DepLt, "DEP LT"},
    {Path::DepLn, "DEP LN"},
    {Path::DepCt, "DEP CT"},
    {Path::DepLct, "DEP LCT"},
    {Path::DepPlct, "DEP PLCT"},
    {Path::Paraxial, ""},
};

}  // namespace fitgauge::klartext
