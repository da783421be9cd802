#pragma once

#include <boost/pfr/ops_fields.hpp>

#include "nc/klartext/syntax.hpp"

namespace fitgauge::klartext {

inline bool is_same(const Statement& a, const Statement& b) {
  const auto has_same_fields = [&](const auto& statement) {
    return boost::pfr::eq_fields(statement, std::get<std::decay_t<decltype(statement)>>(b));
  };
  return a.index() == b.index() && std::visit(has_same_fields, a);
}

inline bool operator==(const Block& a, const Block& b) {
  return a.comment == b.comment && a.number == b.number && a.has_number == b.has_number &&
         a.skip == b.skip && a.comment_mark == b.comment_mark && is_same(a.statement, b.statement);
}

inline bool operator==(const Word& a, const Word& b) {
  return a.value == b.value && a.letter == b.letter && a.incremental == b.incremental &&
         a.argument == b.argument;
}

inline bool operator==(const CycleParameter& a, const CycleParameter& b) {
  return a.parameter == b.parameter && a.kind == b.kind && a.value == b.value &&
         a.comment == b.comment;
}

inline bool operator==(const Node& a, const Node& b) {
  return a.op == b.op && a.height == b.height && a.operands == b.operands;
}

/// Structural: places, source and file name do not count. The pools are filled in the order of the
/// source: equal programs have equal pools.
inline bool operator==(const Program& a, const Program& b) {
  const ProgramParts& x = a.parts();
  const ProgramParts& y = b.parts();
  return x.blocks == y.blocks && x.words == y.words && x.cycle_parameters == y.cycle_parameters &&
         x.nodes == y.nodes && x.operands == y.operands && x.texts == y.texts;
}

}  // namespace fitgauge::klartext
