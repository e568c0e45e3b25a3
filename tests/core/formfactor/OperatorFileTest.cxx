// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/OperatorFile.h"

#include "radiometry/formfactor/DenseOperator.h"
#include "radiometry/formfactor/HierarchicalOperator.h"
#include "radiometry/formfactor/MonteCarloOperator.h"
#include "radiometry/scene/InputError.h"
#include "tests/core/TestScenes.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <vector>

using namespace radiometry;

namespace
{

struct Room
{
  Room()
    : World(MakeScene())
    , Sight(World)
    , Elements(ElementSet(World, true).DividedToArea(0.2))
  {
    this->Options.RelativeTolerance = 0.1;
    this->Head.Geometry = KeyOfGeometry(this->World);
    this->Head.Options = { { "BackFaces", "on" }, { "Seed", "0" } };
    this->Head.Tolerance = 0.1;
    this->Head.Area = 0.2;
  }
  static Scene MakeScene()
  {
    test::Mesh mesh;
    mesh.AddBox({ 0, 0, 0 }, { 2, 2, 2 }, 1, true);
    mesh.AddBox({ 0.4, 0.5, 0.3 }, { 1.1, 1.2, 0.9 }, 1, false);
    return mesh.ToScene(0.5);
  }
  std::unique_ptr<FormFactorOperator> Make(const std::string& kind)
  {
    this->Head.Kind = kind;
    if (kind == "Dense")
    {
      return std::make_unique<DenseOperator>(this->World, this->Sight, this->Elements, this->Options);
    }
    if (kind == "Hierarchical")
    {
      return std::make_unique<HierarchicalOperator>(
        this->World, this->Sight, this->Elements, this->Options);
    }
    return std::make_unique<MonteCarloOperator>(this->Sight, this->Elements, this->Options, 32);
  }

  Scene World;
  OcclusionScene Sight;
  ElementSet Elements;
  ExchangeOptions Options;
  OperatorFileHead Head;
};

std::string TemporaryName(const char* name)
{
  return (std::filesystem::path(testing::TempDir()) / name).string();
}

std::vector<double> Applied(const FormFactorOperator& F)
{
  std::vector<double> x(F.Size()), out(F.Size());
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    x[i] = 1.0 + static_cast<double>(i % 7);
  }
  F.Apply(x.data(), out.data(), 1);
  return out;
}

std::string Slurp(const std::string& name)
{
  std::ifstream stream(name, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

void Spit(const std::string& name, const std::string& bytes)
{
  std::ofstream(name, std::ios::binary) << bytes;
}

/// What reading the file and checking it against a head complains about; empty: nothing.
std::string Complaint(const std::string& name, const OperatorFileHead& wanted)
{
  try
  {
    OperatorFile(name).Check(wanted);
  }
  catch (const InputError& error)
  {
    EXPECT_EQ(error.Array, "OperatorFile");
    return error.Expected;
  }
  return "";
}

} // namespace

TEST(OperatorFile, ComesBackToTheLastBit)
{
  for (const std::string kind : { "Dense", "Hierarchical", "MonteCarlo" })
  {
    Room room;
    const auto F = room.Make(kind);
    const std::string name = TemporaryName("there_and_back.operator");
    WriteOperatorFile(name, room.Head, room.Elements, *F);
    EXPECT_FALSE(std::filesystem::exists(name + ".part"));
    OperatorFile file(name);
    file.Check(room.Head);
    EXPECT_EQ(file.Head().Kind, kind);
    EXPECT_EQ(file.Head().Tolerance, 0.1);
    const ElementSet elements = file.ReadElements();
    ASSERT_EQ(elements.GetAreas(), room.Elements.GetAreas());
    const auto read = file.ReadOperator(room.Sight, elements, room.Options);
    const std::vector<double> before = Applied(*F), after = Applied(*read);
    EXPECT_EQ(std::memcmp(before.data(), after.data(), 8 * before.size()), 0) << kind;
    EXPECT_EQ(read->Samples(), F->Samples());
    EXPECT_EQ(read->Components(), F->Components());
    std::filesystem::remove(name);
  }
}

TEST(OperatorFile, AnyDamageIsSeen)
{
  Room room;
  const auto F = room.Make("MonteCarlo");
  const std::string name = TemporaryName("damaged.operator");
  WriteOperatorFile(name, room.Head, room.Elements, *F);
  const std::string whole = Slurp(name);
  EXPECT_EQ(Complaint(name, room.Head), "");
  // A bit anywhere; an end anywhere; more behind the end.
  for (std::size_t at = 0; at < whole.size(); at += whole.size() / 97 + 1)
  {
    std::string bent = whole;
    bent[at] = static_cast<char>(bent[at] ^ 0x10);
    Spit(name, bent);
    EXPECT_NE(Complaint(name, room.Head), "") << at;
    Spit(name, whole.substr(0, at));
    EXPECT_NE(Complaint(name, room.Head), "") << at;
  }
  Spit(name, whole + "more");
  EXPECT_NE(Complaint(name, room.Head), "");
  std::filesystem::remove(name);
  EXPECT_NE(Complaint(name, room.Head).find("can be read"), std::string::npos);
}

TEST(OperatorFile, RefusedWithAReason)
{
  Room room;
  const auto F = room.Make("Dense");
  const std::string name = TemporaryName("refused.operator");
  WriteOperatorFile(name, room.Head, room.Elements, *F);
  OperatorFileHead moved = room.Head;
  Scene other = room.World;
  other.Points[0].x += 1e-9;
  moved.Geometry = KeyOfGeometry(other);
  EXPECT_NE(Complaint(name, moved).find("points"), std::string::npos);
  OperatorFileHead reseeded = room.Head;
  reseeded.Options[1].second = "7";
  EXPECT_NE(Complaint(name, reseeded).find("Seed was 0 and is 7"), std::string::npos);
  std::string later = Slurp(name);
  later[8] = 9;
  Spit(name, later);
  EXPECT_NE(Complaint(name, room.Head).find("is of version 9"), std::string::npos);
  std::swap(later[12], later[15]);
  Spit(name, later);
  EXPECT_NE(Complaint(name, room.Head).find("order of bytes"), std::string::npos);
  Spit(name, "solid cube\nfacet normal 0 0 1\n");
  EXPECT_NE(Complaint(name, room.Head).find("this is none"), std::string::npos);
  std::filesystem::remove(name);
}

TEST(OperatorFile, WhereNothingCanBeWritten)
{
  Room room;
  const auto F = room.Make("Dense");
  EXPECT_THROW(WriteOperatorFile("/nowhere/at/all.operator", room.Head, room.Elements, *F), InputError);
  // What stands there stays until the new file is whole.
  const std::string name = TemporaryName("kept.operator");
  Spit(name, "before");
  std::filesystem::create_directory(name + ".part");
  EXPECT_THROW(WriteOperatorFile(name, room.Head, room.Elements, *F), InputError);
  EXPECT_EQ(Slurp(name), "before");
  std::filesystem::remove_all(name + ".part");
  std::filesystem::remove(name);
}

TEST(GeometryKey, ContentDecides)
{
  const Scene scene = Room::MakeScene();
  Scene relit = scene;
  relit.Lights.emplace_back();
  relit.Optics.DiffuseReflectance[0].assign(scene.Cells, 0.9);
  relit.Optics.EmittedExitance[0].assign(scene.Cells, 2.0);
  EXPECT_EQ(KeyOfGeometry(scene), KeyOfGeometry(relit));
  std::vector<Scene> changed(5, scene);
  changed[0].Points[1].y = std::nextafter(changed[0].Points[1].y, 9.0);
  std::swap(changed[1].Triangles[0][0], changed[1].Triangles[0][1]);
  changed[2].TriangleCell[0] = 1;
  changed[3].Optics.TwoSided.assign(scene.Cells, 1);
  changed[4].TriangleTransmittance.assign(scene.Triangles.size(), 0.1);
  for (std::size_t k = 0; k < changed.size(); ++k)
  {
    EXPECT_NE(KeyOfGeometry(scene), KeyOfGeometry(changed[k])) << k;
  }
  Scene shiny = scene;
  shiny.Optics.SpecularReflectance[0].assign(scene.Cells, 0.2);
  EXPECT_EQ(KeyOfGeometry(scene), KeyOfGeometry(shiny));
  EXPECT_NE(KeyOfMirrors(scene), KeyOfMirrors(shiny));
}
