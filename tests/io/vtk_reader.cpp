// SPDX-License-Identifier: MIT
// Reads the files with VTK's own reader if VTK's Python module is installed. Otherwise the test is
// reported as skipped.
#include <cstdlib>
#include <doctest/doctest.h>
#include <fstream>
#include <string>
#include <vector>

#include "moreau/io/vtk.hpp"
#include "moreau/shape/ball.hpp"

#include "io/temporary_folder.hpp"
#include "io/vtk_samples.hpp"

using namespace moreau;
using namespace vtk_samples;

TEST_CASE("VTK reads the files") {
  std::string python;
  for (const std::string candidate : {"python3", "/usr/bin/python3"})
    if (python.empty() &&
        std::system((candidate + " -c 'import vtk' > /dev/null 2>&1").c_str()) == 0)
      python = candidate;
  if (python.empty()) {
    MESSAGE("VTK is not installed: skipped");
    return;
  }
  const TemporaryFolder folder("vtk");
  using S = Space<3>;
  const Polyhedron<double> shape = tetrahedron();
  VtkWriter<S> writer;
  const auto pose_of = [](std::size_t k) {
    return Pose<S>{S::Vector::Constant(2 * double(k)), S::identity()};
  };
  const auto twist_of = [](std::size_t k) -> S::Twist { return S::Twist::Constant(double(k)); };
  writer.write_grains(
      folder / "grains.vtp", 5, [&](std::size_t) -> const auto& { return shape; }, pose_of,
      twist_of);
  writer.write_grains(
      folder / "balls.vtp", 5, [](std::size_t) { return Ball<double>(0.5); }, pose_of, twist_of);
  const std::vector<ContactSegment<S>> contacts = {segment<S>({0, 0, 0}, {0, 0, 2}, 8)};
  writer.write_contacts(folder / "contacts.vtp", contacts);
  VtkWriter<S>({3, false})
      .write_grains(
          folder / "surfaces.vtp", 2, [](std::size_t) { return Ball<double>(0.5); }, pose_of,
          twist_of);
  PvdSeries series(folder / "run.pvd");
  for (const char* name : {"grains.vtp", "balls.vtp", "surfaces.vtp"}) series.add(0.25, name);
  series.add(0.5, "contacts.vtp");
  std::ofstream(folder / "check.py") << R"(
import sys, vtk
import xml.etree.ElementTree as xml
def load(name):
    reader = vtk.vtkXMLPolyDataReader()
    failed = []
    reader.AddObserver('ErrorEvent', lambda *_: failed.append(1))
    reader.SetFileName(sys.argv[1] + '/' + name)
    reader.Update()
    assert not failed, name
    return reader.GetOutput()
grains = load('grains.vtp')
assert grains.GetNumberOfPoints() == 20 and grains.GetNumberOfPolys() == 20
assert grains.GetCellData().GetArray('velocity').GetTuple3(19) == (4, 4, 4)
assert grains.GetCellData().GetArray('id').GetValue(19) == 4
mass = vtk.vtkMassProperties()
mass.SetInputData(grains)
assert abs(mass.GetVolume() - 5 / 6) < 1e-5, mass.GetVolume()
balls = load('balls.vtp')
assert balls.GetNumberOfVerts() == 5
assert balls.GetPointData().GetArray('size').GetValue(4) == 1
surfaces = load('surfaces.vtp')
mass.SetInputData(surfaces)
ball = 3.14159265 / 6
assert 0.99 * ball < mass.GetVolume() / 2 < ball, mass.GetVolume()
assert surfaces.GetCellData().GetArray('size').GetValue(0) == 1
series = xml.parse(sys.argv[1] + '/run.pvd').findall('Collection/DataSet')
assert [float(s.get('timestep')) for s in series] == [0.25, 0.25, 0.25, 0.5]
for s in series: assert load(s.get('file')).GetNumberOfCells() > 0
contacts = load('contacts.vtp')
assert contacts.GetNumberOfLines() == 1
assert contacts.GetCellData().GetArray('normal_force').GetValue(0) == 8
)";
  const std::string command =
      python + " '" + (folder / "check.py").string() + "' '" + (folder / "").string() + "'";
  CHECK(std::system(command.c_str()) == 0);
}
