#include "nominal_parts.hpp"

namespace fitgauge::probing {
namespace {

using machine::Block;
using machine::Bore;
using machine::Boss;
using machine::Feature;
using machine::Vec3;

const machine::Plane kFace{};
const Vec3 kAbove{100, 80, 60};
const Vec3 kBeside{-10, 40, -10};

std::vector<Feature> plate_with(const std::vector<std::array<double, 2>>& holes, double diameter) {
  std::vector<Feature> part{kFace};
  for (const auto& centre : holes) {
    part.emplace_back(Bore{.centre = centre, .top = 0, .depth = 30, .diameter = diameter});
  }
  return part;
}
std::vector<Feature> plate_with_studs(const std::vector<std::array<double, 2>>& studs,
                                      double diameter) {
  std::vector<Feature> part{kFace};
  for (const auto& centre : studs) part.emplace_back(Boss{centre, 10, 10, diameter});
  return part;
}
const std::vector<Feature> kRectangle{Block{{0, 0, -60}, {200, 160, -20}},
                                      Block{{70, 60, -20}, {130, 100, 0}}};
const std::vector<Feature> kHole = plate_with({{100, 80}}, 25);
const std::vector<Feature> kStud = plate_with_studs({{100, 80}}, 25);
const std::vector<Feature> kBolts = plate_with({{130, 80}, {100, 110}, {70, 80}}, 10);

const Values kClear{{260, 30.0}, {320, 0.0}};
const Values kQuiet = with(kClear, {{281, 0.0}});
const Values kRow = with(kClear, {{305, 9.0}});
const Values kAlongEdge = values("263=20 264=0 265=180 266=0 272=2 267=1 261=-5");
const Values kRound{{262, 25.0}, {247, 90.0}};
const Values kBoltCircle = values("273=100 274=80 262=60 291=0 292=90 293=180 261=-5");
const Values kTwoHoles{{268, 50.0}, {269, 40.0}, {270, 150.0}, {271, 40.0}};

using Results = std::vector<std::pair<int, double>>;
Results join(Results first, const Results& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}
const Results kGood{{180, 1}, {181, 0}, {182, 0}};
const Results kCentre{{151, 100}, {152, 80}, {161, 0}, {162, 0}};
const Results kCircle = join(kCentre, {{153, 25}, {163, 0}});
const Results kSides = join(kCentre, {{154, 60}, {155, 40}, {164, 0}, {165, 0}});

void add_touches(std::vector<NominalCase>& cases) {
  cases.push_back({0,
                   {kPlate},
                   kAbove,
                   values("result=1600 axis=2 direction=-1 X=50 Y=40 Z=5"),
                   {{1600, 0}},
                   {{2, 0}}});
  cases.push_back({1, {kPlate}, kBeside, values("axis=0 angle=0 X=-10 Y=40 Z=-10"), {}, {{0, 0}}});
  cases.push_back({3,
                   {kPlate},
                   kBeside,
                   values("result=1600 axis=0 angle=0 distance=15"),
                   {{1603, 0}},
                   {{0, 0}}});
  cases.push_back(
      {4, {kPlate}, kBeside, values("result=1600 X=1 distance=15"), {{1603, 0}}, {{0, 0}}});
}

void add_measuring(std::vector<NominalCase>& cases) {
  cases.push_back({420, {kPlate}, {20, -30, 60}, with(kAlongEdge, kQuiet), {{150, 0}}});
  cases.push_back({421, kHole, kAbove,
                   with(with(kRound, kQuiet), values("273=100 274=80 261=-5 275=25.021 276=25")),
                   join(kCircle, kGood)});
  cases.push_back({422, kStud, kAbove,
                   with(with(kRound, kQuiet), values("273=100 274=80 261=5 277=25 278=24.979")),
                   join(kCircle, kGood)});
  for (const int cycle : {423, 424}) {
    cases.push_back(
        {cycle, cycle == 423 ? kPocket : kRectangle, kAbove,
         with(kQuiet, values("273=100 274=80 282=60 283=40 261=-5 284=60 285=60 286=40 287=40")),
         join(kSides, kGood)});
  }
  const Results width = join({{156, 40}, {157, 80}, {166, 0}}, kGood);
  cases.push_back({425, kPocket, kAbove,
                   with(kQuiet, values("328=100 329=80 310=0 272=2 261=-5 311=40 288=40 289=40")),
                   width});
  cases.push_back(
      {426, kRectangle, kAbove,
       with(kQuiet, values("263=100 264=100 265=100 266=60 272=2 261=-5 311=40 288=40 289=40")),
       width});
  cases.push_back({427,
                   {kFace},
                   kAbove,
                   with(kQuiet, values("263=20 264=20 261=0 272=3 267=-1 288=0.001 289=0")),
                   join({{160, 0}, {168, 0}}, kGood)});
  cases.push_back({430, kBolts, kAbove, with(kBoltCircle, values("260=30 281=0 288=60 289=60")),
                   join(join(kCentre, {{153, 60}, {163, 0}}), kGood)});
  cases.push_back(
      {431,
       {kFace},
       kAbove,
       with(kQuiet, values("263=20 264=20 294=0 265=150 266=20 295=0 296=20 297=120 298=0")),
       {{158, 0}, {159, 0}, {170, 0}, {171, 0}, {172, 0}, {173, 0}, {174, 0}, {175, 0}}});
  cases.push_back(
      {444,
       {kFace},
       kAbove,
       with(kClear,
            with(values("263=20 264=30 294=0 581=0 582=0 583=1"), {{400, std::string("0.1-0.1")}})),
       {{151, 20}, {152, 30}, {153, 0}, {161, 0}, {162, 0}, {163, 0}, {164, 0}, {183, 0}}});
}

void add_datums(std::vector<NominalCase>& cases) {
  const Values centre = with(kRow, {{321, 100.0}, {322, 80.0}, {261, -5.0}});
  const Results middle{{157, 80}, {166, 40}};
  cases.push_back({408, kPocket, kAbove, with(centre, {{311, 40.0}, {272, 2.0}}), middle});
  cases.push_back({409, kRectangle, kAbove, with(centre, {{311, 40.0}, {272, 2.0}}), middle});
  const Results sides{{151, 100}, {152, 80}, {154, 60}, {155, 40}};
  cases.push_back({410, kPocket, kAbove, with(centre, {{323, 60.0}, {324, 40.0}}), sides});
  cases.push_back({411, kRectangle, kAbove, with(centre, {{323, 60.0}, {324, 40.0}}), sides});
  const Results circle{{151, 100}, {152, 80}, {153, 25}};
  cases.push_back({412, kHole, kAbove, with(centre, kRound), circle});
  cases.push_back({413, kStud, kAbove, with(with(centre, kRound), {{261, 5.0}}), circle});
  cases.push_back({414,
                   {Block{{100, 80, -40}, {200, 160, 0}}},
                   {60, 60, 60},
                   with(kRow, values("263=110 264=80 326=40 296=100 297=90 327=30 261=-5")),
                   {{151, 100}, {152, 80}}});
  cases.push_back({415,
                   kPocket,
                   kAbove,
                   with(kRow, values("263=70 264=60 326=30 327=20 308=1 261=-5")),
                   {{151, 70}, {152, 60}}});
  cases.push_back(
      {416, kBolts, kAbove, with(kBoltCircle, kRow), {{151, 100}, {152, 80}, {153, 60}}});
  cases.push_back({417, {kPlate}, kAbove, with(kRow, values("263=20 264=20 294=0")), {{160, 0}}});
  cases.push_back(
      {418,
       plate_with({{60, 50}, {140, 50}, {140, 110}, {60, 110}}, 10),
       kAbove,
       with(Values{{260, 30.0}, {305, 9.0}},
            values("268=60 269=50 270=140 271=50 316=140 317=110 318=60 319=110 261=-5")),
       {{151, 100}, {152, 80}}});
  cases.push_back({419,
                   {kPlate},
                   {-40, 40, 60},
                   with(kRow, {{263, 0.0}, {264, 40.0}, {261, -5.0}, {272, 1.0}, {267, 1.0}}),
                   {{160, 0}}});
}

void add_alignment(std::vector<NominalCase>& cases) {
  cases.push_back({400, {kPlate}, {20, -30, 60}, with(kAlongEdge, kClear), {}});
  cases.push_back({401,
                   plate_with({{50, 40}, {150, 40}}, 10),
                   kAbove,
                   with(with(kTwoHoles, {{261, -5.0}}), {{260, 30.0}}),
                   {}});
  cases.push_back({402,
                   plate_with_studs({{50, 40}, {150, 40}}, 10),
                   kAbove,
                   with(with(kTwoHoles, kClear), values("313=10 314=10 261=5 315=5 301=1")),
                   {}});
  cases.push_back({403, {kPlate}, {20, -30, 60}, with(kAlongEdge, kClear), {{150, 0}}});
  cases.push_back({405,
                   plate_with({{100, 80}}, 25),
                   kAbove,
                   with(with(kRound, kClear), {{321, 100.0}, {322, 80.0}, {261, -5.0}}),
                   {{150, 0}}});
}

/// 1400 to 1434: the results, the deviations 30 further on, and the status.
Results object_results(int first, const std::vector<double>& nominal, Results more = {}) {
  for (const double value : nominal) more.push_back({first++, value});
  for (std::size_t i = more.size(); i-- > 0;) more.push_back({more[i].first + 30, 0});
  more.push_back({183, 0});
  return more;
}

void add_objects(std::vector<NominalCase>& cases) {
  const auto near = [](int q, double value, const char* tolerance) {
    return Values{{q, std::to_string(static_cast<int>(value)) + tolerance}};
  };
  const auto point = [](int first, double x, double y, double z) {
    return Values{{first, x}, {first + 1, y}, {first + 2, z}};
  };
  const Values face = with(with(kClear, point(1100, 0, 40, -5)), {{372, 1.0}});
  for (const int cycle : {1400, 1430}) {
    cases.push_back({cycle,
                     {kPlate},
                     {-40, 40, 60},
                     with(face, near(1100, 0, "+-0.1")),
                     object_results(950, {0, 40, -5})});
  }
  const Values middle = with(kClear, point(1100, 100, 80, -5));
  for (const int cycle : {1404, 1434}) {
    cases.push_back({cycle, kPocket, kAbove,
                     with(middle, with(near(1113, 40, "+-0.1"), {{1114, 90.0}})),
                     object_results(950, {100, 80, -5}, {{968, 40}})});
  }
  cases.push_back({1401, kHole, kAbove, with(middle, near(1116, 25, "+-0.1")),
                   object_results(950, {100, 80, -5}, {{966, 25}})});
  cases.push_back({1402,
                   {machine::Sphere{{100, 80, -5}, 25}},
                   kAbove,
                   with(middle, near(1116, 25, "+-0.1")),
                   object_results(950, {100, 80, -5}, {{966, 25}})});
  const Values line = with(with(kClear, {{372, 2.0}}), point(1103, 180, 0, -5));
  cases.push_back({1410,
                   {kPlate},
                   {20, -30, 60},
                   with(with(line, point(1100, 20, 0, -5)), near(1101, 0, "+-0.1")),
                   object_results(950, {20, 0, -5, 180, 0, -5}, {{964, 0}})});
  cases.push_back(
      {1412,
       {kPlate},
       {20, -30, 60},
       with(with(kClear, point(1100, 20, 0, -5)),
            {{1130, 0.0}, {1131, 1.0}, {1132, 10.0}, {1133, 150.0}, {400, std::string("0.1-0.1")}}),
       object_results(950, {30, 0, -5, 170, 0, -5}, {{964, 0}})});
  cases.push_back(
      {1411, plate_with({{50, 40}, {150, 40}}, 10), kAbove,
       with(with(with(kClear, point(1100, 50, 40, -5)), point(1103, 150, 40, -5)),
            with(near(1116, 10, "+-0.1"), {{1117, 10.0}})),
       object_results(950, {50, 40, -5, 150, 40, -5}, {{964, 0}, {966, 10}, {967, 10}})});
  cases.push_back(
      {1420,
       {kFace},
       kAbove,
       with(with(with(kClear, point(1100, 20, 20, 0)), point(1103, 150, 20, 0)),
            with(with(point(1106, 20, 120, 0), {{372, -3.0}}), near(1102, 0, "+-0.1"))),
       object_results(950, {20, 20, 0, 150, 20, 0, 20, 120, 0}, {{961, 0}, {962, 0}, {963, 0}})});
}

}  // namespace

std::vector<NominalCase> nominal_cases() {
  std::vector<NominalCase> cases;
  add_touches(cases);
  add_measuring(cases);
  add_datums(cases);
  add_alignment(cases);
  add_objects(cases);
  for (NominalCase& c : cases) {
    c.only_right_angles = std::ranges::any_of(
        c.part, [](const Feature& feature) { return std::holds_alternative<Block>(feature); });
  }
  return cases;
}

}  // namespace fitgauge::probing
