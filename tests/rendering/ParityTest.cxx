// SPDX-License-Identifier: BSD-3-Clause
// Picture against radiometry/shading, pixel by pixel. Needs a display: run through display.py.
#include "ParityScene.h"

#include "radiometry/scene/ArrayNames.h"
#include "rendering/vtkLinearFloatPass.h"
#include "rendering/vtkPhongGouraudMapper.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace radiometry;

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr int Size = 64;
constexpr double Relative = 2e-5;
constexpr double Floor = 1e-6;

vtkNew<vtkPolyData> MakeLightData(const std::vector<DisplayLight>& lights)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  data->SetPoints(points);
  const auto add = [&data](const char* name, int components) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    data->GetPointData()->AddArray(array);
    return array.Get();
  };
  vtkDoubleArray* type = add(names::LightType, 1);
  vtkDoubleArray* intensity = add(names::Intensity, 3);
  vtkDoubleArray* specular = add(names::SpecularColor, 3);
  vtkDoubleArray* ambient = add(names::AmbientColor, 3);
  vtkDoubleArray* direction = add(names::Direction, 3);
  vtkDoubleArray* cutoff = add(names::SpotCutoff, 1);
  vtkDoubleArray* inner = add(names::SpotInnerCutoff, 1);
  vtkDoubleArray* exponent = add(names::SpotExponent, 1);
  vtkDoubleArray* attenuation = add(names::Attenuation, 3);
  for (const DisplayLight& light : lights)
  {
    const bool directional = light.Position[3] == 0.0;
    const bool spot = !directional && light.CosCutoff > -1.0;
    const auto degrees = [](double cosine) { return std::acos(cosine) * 180.0 / Pi; };
    const double* p = light.Position.data();
    points->InsertNextPoint(p);
    type->InsertNextTuple1(directional ? 2.0 : (spot ? 1.0 : 0.0));
    intensity->InsertNextTuple3(light.Diffuse.r, light.Diffuse.g, light.Diffuse.b);
    specular->InsertNextTuple3(light.Specular.r, light.Specular.g, light.Specular.b);
    ambient->InsertNextTuple3(light.Ambient.r, light.Ambient.g, light.Ambient.b);
    const Vec3 d = directional ? Vec3{ -p[0], -p[1], -p[2] } : light.SpotDirection;
    direction->InsertNextTuple3(d.x, d.y, d.z);
    cutoff->InsertNextTuple1(
      !spot ? 180.0 : (light.CosCutoff == 0.0 ? 90.0 : degrees(light.CosCutoff)));
    inner->InsertNextTuple1(light.SmoothEdge ? degrees(light.CosInnerCutoff) : -1.0);
    exponent->InsertNextTuple1(light.SpotExponent);
    attenuation->InsertNextTuple(light.Attenuation.data());
  }
  return data;
}

void SetMaterial(vtkProperty* property, const DisplayMaterial& material)
{
  property->SetAmbient(1.0);
  property->SetDiffuse(1.0);
  property->SetSpecular(1.0);
  property->SetAmbientColor(material.Ambient.r, material.Ambient.g, material.Ambient.b);
  property->SetDiffuseColor(material.Diffuse.r, material.Diffuse.g, material.Diffuse.b);
  property->SetSpecularColor(material.Specular.r, material.Specular.g, material.Specular.b);
  property->SetSpecularPower(material.Shininess);
}

/// One window for all scenes.
class Stage
{
public:
  Stage()
  {
    this->Window->SetMultiSamples(0);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetSize(Size, Size);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->SetPass(this->Pass);
    this->Renderer->AddActor(this->Actor);
  }
  void Set(const ParityScene& scene)
  {
    vtkNew<vtkPoints> points;
    vtkNew<vtkFloatArray> normals;
    normals->SetNumberOfComponents(3);
    vtkNew<vtkCellArray> cells;
    for (std::size_t i = 0; i < scene.Points.size(); ++i)
    {
      points->InsertNextPoint(scene.Points[i].x, scene.Points[i].y, scene.Points[i].z);
      normals->InsertNextTuple3(scene.Normals[i].x, scene.Normals[i].y, scene.Normals[i].z);
      if (i % 3 == 0)
      {
        cells->InsertNextCell(3);
      }
      cells->InsertCellPoint(static_cast<vtkIdType>(i));
    }
    vtkNew<vtkPolyData> surface;
    surface->SetPoints(points);
    surface->SetPolys(cells);
    surface->GetPointData()->SetNormals(normals);

    this->Mapper = vtkSmartPointer<vtkPhongGouraudMapper>::New();
    this->Mapper->SetInputData(surface);
    this->Mapper->SetShading(scene.Shading);
    this->Mapper->SetReflectionModel(static_cast<int>(scene.Model.Reflection));
    this->Mapper->SetLocalViewer(scene.Model.LocalViewer);
    this->Mapper->SetTwoSided(scene.Model.TwoSided);
    this->Mapper->SetGlobalAmbient(scene.Model.GlobalAmbient.r, scene.Model.GlobalAmbient.g,
      scene.Model.GlobalAmbient.b);
    this->Mapper->SetEmission(
      scene.Front.Emission.r, scene.Front.Emission.g, scene.Front.Emission.b);
    this->Mapper->SetBackEmission(
      scene.Back.Emission.r, scene.Back.Emission.g, scene.Back.Emission.b);
    this->Mapper->SetLightData(MakeLightData(scene.Lights));
    this->Actor->SetMapper(this->Mapper);
    SetMaterial(this->Actor->GetProperty(), scene.Front);
    if (scene.HasBack)
    {
      vtkNew<vtkProperty> back;
      SetMaterial(back, scene.Back);
      this->Actor->SetBackfaceProperty(back);
    }
    else
    {
      this->Actor->SetBackfaceProperty(nullptr);
    }
    vtkNew<vtkMatrix4x4> matrix;
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        matrix->SetElement(i, j, scene.Transform[i][j]);
      }
      matrix->SetElement(i, 3, scene.Shift[i]);
    }
    this->Actor->SetUserMatrix(matrix);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(scene.Eye.x, scene.Eye.y, scene.Eye.z);
    camera->SetFocalPoint(scene.Focus.x, scene.Focus.y, scene.Focus.z);
    camera->SetViewUp(scene.Up.x, scene.Up.y, scene.Up.z);
    camera->SetParallelProjection(scene.Parallel);
    camera->SetParallelScale(scene.ParallelScale);
    camera->SetViewAngle(scene.ViewAngle);
    camera->SetClippingRange(0.1, 20.0);
  }
  const float* Draw()
  {
    this->Window->Render();
    return static_cast<float*>(this->Pass->GetColor()->GetScalarPointer());
  }

  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkLinearFloatPass> Pass;
  vtkNew<vtkActor> Actor;
  vtkSmartPointer<vtkPhongGouraudMapper> Mapper;
};

Stage& TheStage()
{
  static Stage* stage = new Stage; // outlives the tests: contexts and static order do not mix
  return *stage;
}

struct Difference
{
  int Pixels = 0;         // compared
  int IllConditioned = 0; // values that float32 coordinates alone keep from agreeing
  double Worst = 0.0;     // |picture - model|/max(|model|, floor/relative)
  double Brightest = 0.0; // the greatest value compared
};

void Compare(const ParityScene& scene, Difference& total)
{
  Stage& stage = TheStage();
  stage.Set(scene);
  const float* picture = stage.Draw();
  int wrong = 0;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const ParityPixel expected = EvaluatePixel(scene, x, y, Size);
      if (!expected.Comparable)
      {
        continue;
      }
      const float* drawn = picture + 4 * (y * Size + x);
      const double model[3] = { expected.Color.r, expected.Color.g, expected.Color.b };
      ASSERT_EQ(drawn[3], expected.Hit ? 1.0f : 0.0f) << "seed " << scene.Seed;
      total.Pixels += expected.Hit ? 1 : 0;
      for (int c = 0; c < 3; ++c)
      {
        const double off = std::abs(drawn[c] - model[c]);
        const double scale = std::max(std::abs(model[c]), Floor / Relative);
        const double error = off / scale;
        if (error > Relative && FloatSensitivity(scene, x, y, Size) > 0.5 * Relative * scale)
        {
          ++total.IllConditioned;
          continue;
        }
        total.Worst = std::max(total.Worst, error);
        total.Brightest = std::max(total.Brightest, model[c]);
        if (!(error <= Relative) && ++wrong <= 3)
        {
          ADD_FAILURE() << "seed " << scene.Seed << " shading " << scene.Shading << " model "
                        << static_cast<int>(scene.Model.Reflection) << " pixel " << x << " " << y
                        << " band " << c << ": picture " << drawn[c] << ", model " << model[c]
                        << ", error " << error << " [" << stage.Mapper->GetShaderFeatures()
                        << "]";
        }
      }
    }
  }
}

void CompareSeeds(std::uint32_t first, int count, const ParityFeatures& features, const char* name)
{
  const char* shadings[] = { "Flat", "Gouraud", "Phong" };
  for (int shading = 0; shading < 3; ++shading)
  {
    Difference total;
    for (int i = 0; i < count; ++i)
    {
      Compare(MakeParityScene(first + static_cast<std::uint32_t>(i), shading, features), total);
    }
    std::printf("%-12s %-8s %6d pixels, worst %.2e, brightest %.3g, ill-conditioned values %d\n",
      name, shadings[shading], total.Pixels, total.Worst, total.Brightest, total.IllConditioned);
    EXPECT_GT(total.Pixels, 100 * count);
    EXPECT_LE(total.IllConditioned, 0.001 * total.Pixels);
  }
}

ParityFeatures Only()
{
  ParityFeatures features;
  features.AnythingElse = false;
  return features;
}

} // namespace

TEST(Parity, PointLight)
{
  ParityFeatures f = Only();
  f.Point = true;
  CompareSeeds(100, 4, f, "point");
}

TEST(Parity, SpotLight)
{
  ParityFeatures f = Only();
  f.Spot = true;
  CompareSeeds(200, 6, f, "spot");
}

TEST(Parity, DirectionalLight)
{
  ParityFeatures f = Only();
  f.Directional = true;
  CompareSeeds(300, 4, f, "directional");
}

TEST(Parity, Attenuation)
{
  ParityFeatures f = Only();
  f.Point = f.Spot = f.Attenuation = true;
  CompareSeeds(400, 4, f, "attenuation");
}

TEST(Parity, Highlights)
{
  ParityFeatures f = Only();
  f.Point = f.Directional = f.Specular = true;
  CompareSeeds(500, 6, f, "specular");
}

TEST(Parity, TwoSidedWithBackMaterial)
{
  ParityFeatures f = Only();
  f.Point = f.TwoSided = f.BackMaterial = f.Specular = f.Emission = true;
  CompareSeeds(600, 4, f, "two-sided");
}

TEST(Parity, Emission)
{
  ParityFeatures f = Only();
  f.Emission = true; // and no light at all
  CompareSeeds(700, 3, f, "emission");
}

TEST(Parity, ViewerAtInfinity)
{
  ParityFeatures f = Only();
  f.Point = f.Specular = f.ViewerAtInfinity = true;
  CompareSeeds(800, 4, f, "far viewer");
}

TEST(Parity, TransformedActor)
{
  ParityFeatures f = Only();
  f.Point = f.Specular = f.Transformed = f.BackMaterial = true;
  CompareSeeds(900, 6, f, "transformed");
}

TEST(Parity, RandomScenes)
{
  CompareSeeds(1, 80, ParityFeatures(), "random");
}

TEST(Parity, NormalsAndDepth)
{
  ParityFeatures f = Only();
  f.Point = f.Transformed = f.TwoSided = true;
  for (std::uint32_t seed = 1000; seed < 1004; ++seed)
  {
    for (const int shading : { 0, 2 })
    {
      ParityScene scene = MakeParityScene(seed, shading, f);
      scene.Parallel = seed % 2 == 1;
      Stage& stage = TheStage();
      stage.Set(scene);
      stage.Mapper->SetFieldModeToNormals();
      const float* picture = stage.Draw();
      vtkImageData* depthImage = stage.Pass->GetDepth();
      const float* depth = static_cast<float*>(depthImage->GetScalarPointer());
      int compared = 0;
      for (int i = 0; i < Size * Size; ++i)
      {
        const ParityPixel expected = EvaluatePixel(scene, i % Size, i / Size, Size);
        if (!expected.Comparable)
        {
          continue;
        }
        if (!expected.Hit)
        {
          EXPECT_EQ(depth[i], 1e10f);
          continue;
        }
        ++compared;
        for (int c = 0; c < 3; ++c)
        {
          EXPECT_NEAR(picture[4 * i + c], expected.Normal[c], 2e-6);
        }
        EXPECT_NEAR(depth[i], expected.Depth, 2e-5 * expected.Depth);
      }
      EXPECT_GT(compared, 100);
    }
  }
}
