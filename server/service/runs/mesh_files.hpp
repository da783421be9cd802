#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "nc/machine/machine_setup.hpp"
#include "nc/program/control_disk.hpp"

namespace fitgauge::app {

/// What becomes of a file that is not there: a setup may be stored before its parts are.
enum class MissingFiles : std::uint8_t { Allowed, Refused };

/// The STL files of one disk: a mesh that some order still holds is not read again, so that orders
/// of one part share it. For one thread.
class MeshFiles {
 public:
  /// The most triangles of one workpiece, in about 25 MB.
  static constexpr std::size_t kMostTriangles = 200'000;

  /// @param disk outlives this.
  explicit MeshFiles(const interpreter::ControlDisk& disk) : disk_(disk) {}

  /// Gives the meshes of the setup their bodies.
  /// @param pointer of the setup in its request
  /// @errors RequestInvalid with one detail for each file: FileUnknown, or FieldInvalid where it is
  ///   no closed mesh or makes too many triangles.
  Result<void> load(machine::Setup& setup, std::string_view pointer, MissingFiles missing);

 private:
  using Body = std::shared_ptr<const machine::TriangleTree>;
  Result<Body> body_of(const machine::Mesh& mesh);

  const interpreter::ControlDisk& disk_;
  std::map<std::string, std::weak_ptr<const machine::TriangleTree>> known_;
};

}  // namespace fitgauge::app
