#include "service/tables/live_tables.hpp"

#include "service/tables/table_catalog.hpp"
#include "tables/tabfile/iso286_projection.hpp"
#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::app {
namespace {

interpreter::ProjectingDisk::Projection projection(const iso286::ToleranceTables& tables,
                                                   iso286::Feature feature) {
  auto table = std::make_shared<const tabfile::TabTable>(tabfile::project(tables, feature));
  return {.file_name = "82553_" + std::string(word(feature)) + ".tab",
          .bytes = std::make_shared<const std::string>(tabfile::write_tab(*table)),
          .revision = tables.revision().id,
          .table = table};
}

}  // namespace

std::vector<interpreter::ProjectingDisk::Projection> project(
    const iso286::ToleranceTables& tables) {
  return {projection(tables, iso286::Feature::Hole), projection(tables, iso286::Feature::Shaft)};
}

std::vector<interpreter::ProjectingDisk::Projection> LiveTables::projections() {
  const auto tables = catalog_.tables();
  if (!tables) return {};
  const std::lock_guard lock(mutex_);
  if (const std::string& revision = (*tables)->revision().id; revision_ != revision) {
    projections_ = project(**tables);
    revision_ = revision;
  }
  return projections_;
}

}  // namespace fitgauge::app
