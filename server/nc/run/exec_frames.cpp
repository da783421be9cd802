#include "nc/klartext/block_reader.hpp"
#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::PlaneKind;

/// Words of PLANE by letter; a word without a value counts as 1.
using PlaneWords = std::map<Letter, double>;

NcResult<PlaneWords> read_plane_words(Channel& channel, Slice<Word> slice) {
  PlaneWords words;
  for (const Word& word : channel.program().view(slice))
    words[word.letter] = is_absent(word.value) ? 1 : TRY(number(channel, word.value));
  return words;
}

double get(const PlaneWords& words, Letter letter) {
  const auto it = words.find(letter);
  return it == words.end() ? 0 : it->second;
}

Vec3 get(const PlaneWords& words, Letter x, Letter y, Letter z) {
  return {get(words, x), get(words, y), get(words, z)};
}

Matrix3 from_axes(const Vec3& x, const Vec3& z) {
  return Matrix3{{x, cross(z, x), z}}.transposed();
}

/// The plane of a normal, its X axis as near as possible to `x`. @errors 1018.
NcResult<Matrix3> plane_of(const Vec3& normal, const Vec3& x) {
  if (norm(normal) < tolerance::kSameDirection)
    return nc_error(1018, "the normal vector has no length");
  const Vec3 z = unit(normal);
  const Vec3 in_plane = x - z * dot(x, z);
  if (norm(in_plane) < tolerance::kSameDirection)
    return nc_error(1018, "base and normal vector are parallel");
  return from_axes(unit(in_plane), z);
}

Matrix3 around(Letter axis, double angle) {
  const Vec3 direction{axis == Letter::Spa ? 1.0 : 0.0, axis == Letter::Spb ? 1.0 : 0.0,
                       axis == Letter::Spc ? 1.0 : 0.0};
  return Matrix3::rotation(direction, angle);
}

Matrix3 current_rotation(const Channel& channel) {
  const auto& plane = channel.state().frames.plane();
  return plane ? Matrix3::spatial(plane->spatial_deg) : Matrix3{};
}

/// PLANE AXIAL: the plane across the tool with the rotary axes at these positions.
NcResult<Matrix3> axial(const Channel& channel, const PlaneWords& words) {
  const MachineState& state = channel.state();
  Vec3 rotary = state.position().rotary;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto it = words.find(static_cast<Letter>(i + 3));
    if (it != words.end()) rotary[i] = it->second;
  }
  rotary = state.frames.rotary_to_machine(rotary, CoordinateSystem::Input);
  return plane_of(state.kinematics.tool_on_table(rotary, state.tool_axis()),
                  state.kinematics.table(rotary).inverse().direction({1, 0, 0}));
}

/// The rotation of a plane relative to the workpiece system.
NcResult<Matrix3> rotation_of(const Channel& channel, PlaneKind kind, const PlaneWords& words) {
  switch (kind) {
    case PlaneKind::Spatial:
      return Matrix3::spatial(get(words, Letter::Spa, Letter::Spb, Letter::Spc));
    case PlaneKind::Relativ:
      for (const Letter axis : {Letter::Spa, Letter::Spb, Letter::Spc}) {
        if (words.contains(axis)) return current_rotation(channel) * around(axis, get(words, axis));
      }
      return nc_error(1018, "PLANE RELATIV needs SPA, SPB or SPC");
    case PlaneKind::Euler:
      return around(Letter::Spc, get(words, Letter::EulPr)) *
             around(Letter::Spa, get(words, Letter::EulNu)) *
             around(Letter::Spc, get(words, Letter::EulRot));
    case PlaneKind::Vector:
      return plane_of(get(words, Letter::Nx, Letter::Ny, Letter::Nz),
                      get(words, Letter::Bx, Letter::By, Letter::Bz));
    case PlaneKind::Projected: {
      const auto [main_sine, main_cosine] = machine::sine_cosine(get(words, Letter::ProPr));
      const auto [minor_sine, minor_cosine] = machine::sine_cosine(get(words, Letter::ProMin));
      const Vec3 along_x{main_cosine, 0, main_sine};
      const Vec3 along_y{0, minor_cosine, minor_sine};
      auto plane = TRY(plane_of(cross(along_x, along_y), along_x));
      return plane * around(Letter::Spc, get(words, Letter::Rot));
    }
    case PlaneKind::Points: {
      const Vec3 first = get(words, Letter::P1x, Letter::P1y, Letter::P1z);
      const Vec3 x = get(words, Letter::P2x, Letter::P2y, Letter::P2z) - first;
      const Vec3 third = get(words, Letter::P3x, Letter::P3y, Letter::P3z) - first;
      return plane_of(cross(x, third), x);
    }
    case PlaneKind::Axial: return axial(channel, words);
    case PlaneKind::Reset: break;
  }
  return Matrix3{};
}

NcResult<void> note_missing(Channel& channel, PlaneKind kind, const PlaneWords& words) {
  // Of the planes after Points, one word is enough; P3z is the last letter of PLANE.
  const bool needs_all = kind <= PlaneKind::Points;
  std::string missing;
  for (auto letter = Letter::X; needs_all && letter <= Letter::P3z;
       letter = static_cast<Letter>(static_cast<int>(letter) + 1)) {
    if (!klartext::words_of(kind).contains(letter) || words.contains(letter)) continue;
    missing += (missing.empty() ? "" : ", ") + std::string(klartext::spelling(letter));
  }
  if (missing.empty()) return {};
  return channel.note("PLANE without " + missing + ", which counts as 0: write it");
}

NcResult<PlaneMoves> moves_of(Channel& channel, const klartext::Plane& plane,
                              const PlaneWords& words) {
  PlaneMoves moves{.positioning = plane.positioning,
                   .feed = Feed::rapid(),
                   .turns_table = words.contains(Letter::TableRot)};
  for (const Word& word : channel.program().view(plane.words)) {
    if (!klartext::kFeeds.contains(word.letter)) continue;
    moves.feed = TRY(read_feed(channel, word));
  }
  if (words.contains(Letter::MbMax) || words.contains(Letter::Mb)) {
    moves.retraction = MCall{.number = 140,
                             .length = get(words, Letter::Mb) * channel.length_unit(),
                             .to_limit = words.contains(Letter::MbMax),
                             .feed = moves.feed};
  }
  moves.distance = get(words, Letter::Dist) * channel.length_unit();
  moves.is_symmetric = words.contains(Letter::Sym);
  moves.sequence = static_cast<int>(get(words, Letter::Seq) + get(words, Letter::Sym));
  return moves;
}

NcResult<void> execute_datum_table(Channel& channel, const klartext::Trans& trans) {
  const auto words = TRY(read_plane_words(channel, trans.words));
  if (!is_absent(trans.table)) {
    const auto written = TRY(text(channel, trans.table));
    const auto path = TRY(channel.resolve(written));
    TRY(channel.tables.select_datum_table(path));
  }
  return shift_datum_to_row(channel, static_cast<std::int64_t>(get(words, Letter::Row)));
}

}  // namespace

NcResult<void> execute(Channel& channel, const klartext::Trans& trans) {
  using enum klartext::Transformation;
  if ((trans.kind == Datum || trans.kind == DatumTable) && trans.reset)
    return reset_datum_shift(channel);
  if (trans.kind == DatumTable) return execute_datum_table(channel, trans);
  // Without words a transformation ends.
  const int cycle = trans.kind == Datum      ? 7
                    : trans.kind == Mirror   ? 8
                    : trans.kind == Rotation ? 10
                                             : 11;
  return execute_transformation(channel, cycle, channel.program().view(trans.words));
}

NcResult<void> execute(Channel& channel, const klartext::Plane& plane) {
  const auto words = TRY(read_plane_words(channel, plane.words));
  TRY(note_missing(channel, plane.kind, words));
  const auto moves = TRY(moves_of(channel, plane, words));
  if (plane.kind == PlaneKind::Reset) return reset_tilt(channel, moves);
  const auto rotation = TRY(rotation_of(channel, plane.kind, words));
  return tilt(channel, rotation, moves);
}

NcResult<void> execute(Channel& channel, const klartext::FunctionTcpm& tcpm) {
  const std::string_view options = channel.program().text(tcpm.options);
  const auto says = [&](std::string_view words) { return options.find(words) != options.npos; };
  const MachineState& state = channel.state();
  const Tool* tool = state.active_tool();
  if (says("CENTER") && tool != nullptr && tool->r2 + tool->dr2 + state.tool.dr2 != 0) {
    return nc_error(
        "REFPNT is the tip here, and R2 of the tool is not 0: program the tip with REFPNT TIP-TIP");
  }
  if (says("F CONT")) TRY(channel.note("F CONT: F counts at the tip, as with F TCP"));
  if (says("FMAX") || options.find_first_of("0123456789") != options.npos) {
    TRY(channel.note(
        "FUNCTION TCPM F: the compensating moves of the linear axes take no feed of their own"));
  }
  channel.spatial_angles.reset();
  if (says("AXIS SPAT")) channel.spatial_angles.emplace();
  channel.turns_along_vector = says("PATHCTRL VECTOR");
  Modes modes = state.modes;
  modes.tcpm = tcpm.active;
  return channel.machine().set_modes(modes);
}

}  // namespace fitgauge::interpreter
