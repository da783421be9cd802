#include "service/runs/control_files.hpp"

#include "nc/machine/triangle_tree.hpp"
#include "service/tables/table_catalog.hpp"
#include "tables/tabfile/iso286_projection.hpp"

namespace fitgauge::app {
namespace {

using machine::Mesh;
using machine::Triangle;
using machine::TriangleTree;
using machine::Vec3;

Error refused(std::string message) { return {ErrorCode::FieldInvalid, std::move(message)}; }

Result<std::shared_ptr<const TriangleTree>> read_body(std::string_view bytes, double unit) {
  auto triangles = TRY(machine::read_stl(bytes));
  TRY(machine::check_closed(triangles));
  for (Triangle& triangle : triangles)
    for (Vec3& corner : triangle) corner = corner * unit;
  return std::make_shared<const TriangleTree>(std::move(triangles));
}

interpreter::ProjectingDisk::Projection projection(const iso286::ToleranceTables& tables,
                                                   iso286::Feature feature) {
  auto table = std::make_shared<const tabfile::TabTable>(tabfile::project(tables, feature));
  return {.file_name = "82553_" + std::string(word(feature)) + ".tab",
          .bytes = std::make_shared<const std::string>(tabfile::write_tab(*table)),
          .revision = tables.revision().id,
          .table = table};
}

}  // namespace

Result<MeshFiles::Body> MeshFiles::body_of(const Mesh& mesh) {
  const auto path = interpreter::ControlPath::parse(mesh.file).value();
  const auto revision = disk_.revision(path);
  if (!revision) return Error{ErrorCode::FileUnknown, mesh.file + " is not on the control's disk"};
  std::erase_if(known_, [](const auto& entry) { return entry.second.expired(); });
  const std::string key = fmt::format("{} {} {}", path.key(), *revision, mesh.unit);
  // The last order that holds it may end at any moment.
  if (const auto known = known_.find(key); known != known_.end()) {
    if (Body body = known->second.lock()) return body;
  }
  const auto file = disk_.find(path);
  if (!file) return Error{ErrorCode::FileUnknown, mesh.file + " is not on the control's disk"};
  auto body = read_body(*file->bytes, mesh.unit);
  if (!body) return refused(mesh.file + " " + body.error().message);
  known_[key] = *body;
  return body;
}

Result<void> MeshFiles::load(machine::Setup& setup, std::string_view pointer,
                             MissingFiles missing) {
  std::vector<Error> found;
  std::size_t triangles = 0;
  machine::each_feature(setup, [&](const std::string& at, machine::Feature& feature) {
    Mesh* const mesh = std::get_if<Mesh>(&feature);
    if (mesh == nullptr) return;
    auto body = body_of(*mesh);
    if (body && (triangles += (*body)->triangles().size()) > kMostTriangles) {
      body =
          refused(fmt::format("the meshes of a workpiece must have at most {} triangles together; "
                              "with {} there are {}: export it with a coarser tolerance",
                              kMostTriangles, mesh->file, triangles));
    }
    if (body) {
      mesh->body = *std::move(body);
    } else if (body.error().code != ErrorCode::FileUnknown || missing == MissingFiles::Refused) {
      found.push_back(body.error());
      found.back().where = fmt::format("{}{}/file", pointer, at);
    }
  });
  if (found.empty()) return {};
  return listed(ErrorCode::RequestInvalid, std::move(found));
}

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
