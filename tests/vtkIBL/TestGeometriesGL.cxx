// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What is lit: every kind of geometry, mapper, prop, transform and camera that VTK has for surfaces. Two witnesses,
// both closed forms: white surfaces in a world of radiance 1 show 1; in a world of radiance 1 + y, a matt surface of
// normal n shows 1 + 2/3 n.y, and a mirror 1 + r.y.
#include "TestScene.h"

#include "vtkIBLBRDFTable.h"
#include "vtkIBLSceneNeeds.h"
#include "vtkIBLSpecularChain.h"

#include <vtkAssembly.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellPicker.h>
#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkCompositePolyDataMapper2.h>
#include <vtkFloatArray.h>
#include <vtkFollower.h>
#include <vtkGlyph3DMapper.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkImageSlice.h>
#include <vtkInformation.h>
#include <vtkLODActor.h>
#include <vtkLODProp3D.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkPolyDataTangents.h>
#include <vtkPropAssembly.h>
#include <vtkPropPicker.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkSphereSource.h>
#include <vtkTextActor3D.h>
#include <vtkTexture.h>
#include <vtkTransform.h>
#include <vtkVolume.h>

#include <functional>
#include <numeric>

namespace
{
constexpr int Size = 96;

RGB Upwards(Vec3 d)
{
  return { 1 + d.y, 1 + d.y, 1 + d.y };
}

void MakeWhite(vtkProperty* property)
{
  property->SetInterpolationToPBR();
  property->SetColor(1, 1, 1);
  property->SetMetallic(1);
  property->SetRoughness(0.5);
}

vtkSmartPointer<vtkPolyData> CopyWithoutNormals(vtkPolyData* surface)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(surface);
  copy->GetPointData()->SetNormals(nullptr);
  return copy;
}

vtkSmartPointer<vtkTexture> MakeTexture(bool sRGB, const std::function<RGB(int, int)>& f)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(8, 8, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int i = 0; i < 3 * 64; ++i)
  {
    static_cast<unsigned char*>(image->GetScalarPointer())[i] =
      static_cast<unsigned char>(std::lround(255 * f(i / 3 % 8, i / 24)[i % 3]));
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->SetUseSRGBColorSpace(sRGB);
  texture->InterpolateOn();
  return texture;
}

// Ray of pixel (i, j), in the world, at the distance 4 that the camera has.
struct Ray
{
  Vec3 Origin, Direction;
};
}

// A unit sphere of 96 x 96 facets before a camera at z = 4 in a picture that it fills by half; no lights.
class TestGeometriesGL : public GLTest
{
protected:
  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkLight> Light;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkIBLEnvironment> White;
  vtkNew<vtkIBLEnvironment> Slope;
  vtkNew<vtkIBLRenderPass> Pass;

  void SetUp() override
  {
    GLTest::SetUp();
    this->Window->SetSize(Size, Size);
    this->Sphere->SetRadius(1);
    this->Sphere->SetThetaResolution(96);
    this->Sphere->SetPhiResolution(96);
    this->Sphere->Update();
    this->Mapper->SetInputData(this->Sphere->GetOutput());
    this->Actor->SetMapper(this->Mapper);
    MakeWhite(this->Actor->GetProperty());
    this->Light->SetPosition(1, 2, 3);
    this->Renderer->AutomaticLightCreationOff();
    this->Renderer->AddActor(this->Actor);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(0, 0, 4);
    camera->SetClippingRange(0.1, 20);
    this->White->SetInputData(MakePanorama(16, [](Vec3) { return RGB{ 1, 1, 1 }; }));
    this->Slope->SetInputData(MakePanorama(128, Upwards));
    this->Pass->SetEnvironment(this->White);
    this->Window->AddRenderer(this->Renderer);
  }

  std::vector<unsigned char> Render(vtkRenderPass* pass)
  {
    this->Renderer->SetPass(pass);
    this->Window->Render();
    return GetPicture(this->Window);
  }

  vtkSmartPointer<vtkImageData> Capture()
  {
    this->Renderer->SetPass(this->Pass);
    return this->Pass->CaptureRadiance(this->Renderer);
  }

  // White surfaces in white light: each of at least `pixels` covered ones shows 1, and under VTK's light alone the
  // picture is VTK's own, byte for byte.
  void ExpectFurnace(const char* what, int pixels = 1000, double truth = 1.0, double tolerance = 2e-3)
  {
    this->Renderer->AddLight(this->Light);
    const std::vector<unsigned char> own = this->Render(nullptr);
    this->White->SetIntensity(0.0);
    const std::vector<unsigned char> dark = this->Render(this->Pass);
    EXPECT_EQ(
      std::inner_product(own.begin(), own.end(), dark.begin(), 0, std::plus<>(), std::not_equal_to<unsigned char>()), 0)
      << what << " without light";
    this->White->SetIntensity(1.0);
    this->Renderer->RemoveAllLights();
    vtkSmartPointer<vtkImageData> picture = this->Capture();
    const auto* rgba = static_cast<const float*>(picture->GetScalarPointer());
    int covered = 0;
    for (int i = 0; i < 4 * Size * Size; i += 4)
    {
      if (rgba[i + 3] > 0)
      {
        ++covered;
        for (int k = 0; k < 3; ++k)
        {
          ASSERT_NEAR(rgba[i + k], truth, tolerance) << what << " " << i / 4 % Size << " " << i / 4 / Size;
        }
      }
    }
    EXPECT_GE(covered, pixels) << what;
  }

  Ray GetRay(int i, int j)
  {
    const double x = 2 * (i + 0.5) / Size - 1;
    const double y = 2 * (j + 0.5) / Size - 1;
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    if (camera->GetParallelProjection())
    {
      const double half = camera->GetParallelScale();
      return { { half * x, half * y, 0 }, { 0, 0, -1 } };
    }
    const double half = std::tan(camera->GetViewAngle() * vtkIBLReference::Pi / 360);
    return { { 0, 0, 4 }, vtkIBLReference::Normalize({ half * x, half * y, -1 }) };
  }

  // The picture of the unit sphere under `model`, as the camera at z = 4 sees it, shows the normals and the reflections
  // of that ellipsoid. `around`: where the camera's z = 0 is in the world. 6e-3: facets of 3.75 degrees, texels of 1.4.
  void ExpectEllipsoid(
    const char* what, const vtkMatrix4x4* model, Vec3 around = {}, double tolerance = 6e-3, bool inside = false)
  {
    double linear[3][3];
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        linear[i][j] = model->GetElement(i, j);
      }
    }
    double inverse[3][3];
    vtkMath::Invert3x3(linear, inverse);
    auto times = [](const double m[3][3], Vec3 v, bool transposed)
    {
      double in[3] = { v.x, v.y, v.z };
      double out[3] = {};
      for (int i = 0; i < 9; ++i)
      {
        out[i / 3] += (transposed ? m[i % 3][i / 3] : m[i / 3][i % 3]) * in[i % 3];
      }
      return Vec3{ out[0], out[1], out[2] };
    };
    const Vec3 centre{ model->GetElement(0, 3) - around.x, model->GetElement(1, 3) - around.y,
      model->GetElement(2, 3) - around.z };
    this->Pass->SetEnvironment(this->Slope);
    for (bool mirror : { false, true })
    {
      vtkProperty* property = this->Actor->GetProperty();
      property->SetMetallic(mirror);
      property->SetRoughness(mirror ? 0 : 1);
      property->SetBaseIOR(mirror ? 1.5 : 1.0); // matt: no reflection at all
      vtkSmartPointer<vtkImageData> picture = this->Capture();
      int compared = 0;
      for (int j = 0; j < Size; ++j)
      {
        for (int i = 0; i < Size; ++i)
        {
          const Ray ray = this->GetRay(i, j);
          const Vec3 o = times(inverse, ray.Origin + -1.0 * centre, false);
          const Vec3 d = times(inverse, ray.Direction, false);
          const double a = Dot(d, d), b = Dot(o, d), c = Dot(o, o) - 1;
          if (b * b - a * c < 0)
          {
            continue;
          }
          const double t = (-b + (inside ? 1 : -1) * std::sqrt(b * b - a * c)) / a;
          const double side = inside ? -1.0 : 1.0;
          const Vec3 n = vtkIBLReference::Normalize(side * times(inverse, o + t * d, true));
          const double NoV = -Dot(n, ray.Direction);
          if (NoV < 0.35) // a pixel is many degrees wide there
          {
            continue;
          }
          const double truth = mirror ? 1 + ray.Direction.y + 2 * NoV * n.y : 1 + 2.0 / 3 * n.y;
          ++compared;
          ASSERT_NEAR(static_cast<const float*>(picture->GetScalarPointer(i, j, 0))[1], truth, tolerance)
            << what << (mirror ? " mirror " : " matt ") << i << " " << j << " NoV " << NoV;
        }
      }
      EXPECT_GT(compared, 500) << what;
    }
    MakeWhite(this->Actor->GetProperty());
    this->Actor->GetProperty()->SetBaseIOR(1.5);
    this->Pass->SetEnvironment(this->White);
  }

  void ExpectTransform(const char* what, const std::function<void(vtkTransform*)>& build)
  {
    vtkNew<vtkTransform> transform;
    build(transform);
    this->Actor->SetUserMatrix(transform->GetMatrix());
    for (bool parallel : { false, true })
    {
      this->Renderer->GetActiveCamera()->SetParallelProjection(parallel);
      this->Renderer->GetActiveCamera()->SetParallelScale(1.2);
      this->ExpectEllipsoid(what, transform->GetMatrix());
    }
  }
};

// Points, lines and surfaces, with and without normals of their own. Mutants: a normal left at 0 or NaN, V behind the
// surface.
TEST_F(TestGeometriesGL, LightsEveryRepresentation)
{
  vtkProperty* property = this->Actor->GetProperty();
  this->Sphere->SetThetaResolution(24);
  this->Sphere->SetPhiResolution(24);
  this->Sphere->Update();
  vtkNew<vtkPolyDataNormals> cellNormals;
  cellNormals->SetInputData(this->Sphere->GetOutput());
  cellNormals->ComputePointNormalsOff();
  cellNormals->ComputeCellNormalsOn();
  cellNormals->Update();
  const std::pair<const char*, vtkSmartPointer<vtkPolyData>> surfaces[] = {
    { "point normals", this->Sphere->GetOutput() },
    { "no normals", CopyWithoutNormals(this->Sphere->GetOutput()) },
    { "cell normals", CopyWithoutNormals(cellNormals->GetOutput()) },
  };
  for (const auto& [name, surface] : surfaces)
  {
    this->Mapper->SetInputData(surface);
    for (bool parallel : { false, true })
    {
      this->Renderer->GetActiveCamera()->SetParallelProjection(parallel);
      const std::string what = std::string(name) + (parallel ? ", parallel" : "");
      this->ExpectFurnace(what.c_str(), 2000);
      property->SetRepresentationToWireframe();
      this->ExpectFurnace((what + ", wireframe").c_str(), 500);
      property->RenderLinesAsTubesOn();
      property->SetLineWidth(5);
      this->ExpectFurnace((what + ", tubes").c_str());
      property->RenderLinesAsTubesOff();
      property->SetLineWidth(1);
      property->SetRepresentationToPoints();
      property->SetPointSize(3);
      this->ExpectFurnace((what + ", points").c_str(), 500);
      property->RenderPointsAsSpheresOn();
      property->SetPointSize(9);
      this->ExpectFurnace((what + ", spheres").c_str());
      property->RenderPointsAsSpheresOff();
      property->SetRepresentationToSurface();
      property->VertexVisibilityOn();
      property->SetVertexColor(1, 1, 1);
      this->ExpectFurnace((what + ", vertices").c_str(), 2000);
      property->VertexVisibilityOff();
      property->SetPointSize(1);
    }
  }
}

// A surface's edges are VTK's: black, since PBR takes their colour for albedo 0 and nothing else; the rest stays white.
TEST_F(TestGeometriesGL, LeavesEdgesToVTK)
{
  this->Sphere->SetThetaResolution(8);
  this->Sphere->SetPhiResolution(8);
  this->Sphere->Update();
  vtkProperty* property = this->Actor->GetProperty();
  property->EdgeVisibilityOn();
  property->SetLineWidth(2);
  vtkSmartPointer<vtkImageData> picture = this->Capture();
  const auto* rgba = static_cast<const float*>(picture->GetScalarPointer());
  int white = 0;
  int black = 0;
  for (int i = 0; i < 4 * Size * Size; i += 4)
  {
    if (rgba[i + 3] > 0)
    {
      ASSERT_LT(rgba[i], 1 + 2e-3);
      white += rgba[i] > 1 - 2e-3;
      black += rgba[i] < 0.3;
    }
  }
  EXPECT_GT(white, 1000);
  EXPECT_GT(black, 200);
  property->RenderLinesAsTubesOn(); // edges of a colour that is lit
  property->SetEdgeColor(1, 1, 1);
  this->ExpectFurnace("edges as tubes", 2000);
}

// Every prop and mapper of surfaces. Mutant: a prop that does not hand the pass on to its parts.
TEST_F(TestGeometriesGL, LightsEveryPropAndMapper)
{
  auto expectProp = [this](const char* what, vtkProp* prop)
  {
    this->Renderer->RemoveAllViewProps();
    this->Renderer->AddViewProp(prop);
    this->ExpectFurnace(what, 500);
    this->Renderer->RemoveAllViewProps();
  };
  vtkNew<vtkActor> child;
  child->SetMapper(this->Mapper);
  child->SetPosition(0.5, 0, 0);
  child->SetScale(0.5);
  MakeWhite(child->GetProperty());
  vtkNew<vtkAssembly> inner;
  inner->AddPart(child);
  vtkNew<vtkAssembly> outer;
  outer->AddPart(inner);
  outer->AddPart(this->Actor);
  outer->RotateZ(30);
  expectProp("assembly of an assembly", outer);
  vtkNew<vtkPropAssembly> propAssembly;
  propAssembly->AddPart(outer);
  expectProp("prop assembly", propAssembly);

  vtkNew<vtkFollower> follower;
  follower->SetMapper(this->Mapper);
  follower->SetCamera(this->Renderer->GetActiveCamera());
  MakeWhite(follower->GetProperty());
  expectProp("follower", follower);
  vtkNew<vtkLODActor> lodActor;
  lodActor->SetMapper(this->Mapper);
  MakeWhite(lodActor->GetProperty());
  expectProp("LOD actor", lodActor);
  this->Messages.Take(); // VTK's own: it uses what it calls deprecated
  vtkNew<vtkProperty> white;
  MakeWhite(white);
  vtkNew<vtkLODProp3D> lodProp;
  lodProp->AddLOD(this->Mapper, white, 0.0);
  expectProp("LOD prop", lodProp);

  vtkNew<vtkPoints> points;
  for (int i = 0; i < 9; ++i)
  {
    points->InsertNextPoint(0.6 * (i % 3 - 1), 0.6 * (i / 3 - 1), 0);
  }
  vtkNew<vtkPolyData> places;
  places->SetPoints(points);
  vtkNew<vtkGlyph3DMapper> glyphs;
  glyphs->SetInputData(places);
  glyphs->SetSourceConnection(this->Sphere->GetOutputPort());
  glyphs->SetScaleFactor(0.25);
  vtkNew<vtkActor> glyphActor;
  glyphActor->SetMapper(glyphs);
  MakeWhite(glyphActor->GetProperty());
  expectProp("glyphs", glyphActor);
}

// Blocks of a composite, each with a colour of its own, which is linear albedo; a matt surface without reflections has
// exactly that radiance.
TEST_F(TestGeometriesGL, LightsBlocksInTheirColours)
{
  const RGB colours[] = { { 1, 1, 1 }, { 0.8, 0.4, 0.2 } };
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 2; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(i ? 0.5 : -0.5, 0, 0);
    sphere->Update();
    blocks->SetBlock(i, sphere->GetOutput());
  }
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputDataObject(blocks);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetCompositeDataDisplayAttributes(attributes);
  for (unsigned int i = 0; i < 2; ++i)
  {
    attributes->SetBlockColor(blocks->GetBlock(i), colours[i].data());
  }
  this->Actor->SetMapper(mapper);
  vtkProperty* property = this->Actor->GetProperty();
  property->SetMetallic(0);
  property->SetBaseIOR(1);
  vtkSmartPointer<vtkImageData> picture = this->Capture();
  for (int k = 0; k < 3; ++k)
  {
    for (int i = 0; i < 2; ++i)
    {
      EXPECT_NEAR(picture->GetScalarComponentAsDouble(i ? 64 : 32, 48, 0, k), colours[i][k], 2e-3) << i;
    }
  }
}

// VTK's PBR takes colours for linear albedo. So a matt surface in the mean light of 1 that NormalizeExposure makes has
// the radiance of its map's colour c, by point and by cell, and shows c^(1/2.2) on the screen. 1: bytes. Mutant: the
// scale of exposure dropped.
TEST_F(TestGeometriesGL, ShowsTheColoursOfAMap)
{
  this->White->SetInputData(MakePanorama(16, [](Vec3) { return RGB{ 7, 7, 7 }; }));
  this->White->NormalizeExposureOn();
  vtkProperty* property = this->Actor->GetProperty();
  property->SetMetallic(0);
  property->SetBaseIOR(1);
  const RGB colours[] = { { 0, 0.25, 0.5 }, { 0.2, 0.6, 0.4 }, { 1, 0.8, 0 } };
  vtkNew<vtkLookupTable> map;
  map->SetNumberOfTableValues(3);
  map->SetTableRange(0, 2);
  for (int i = 0; i < 3; ++i)
  {
    map->SetTableValue(i, colours[i][0], colours[i][1], colours[i][2]);
  }
  this->Mapper->SetLookupTable(map);
  this->Mapper->SetScalarRange(0, 2);
  for (const std::string way : { "points", "points, interpolated before mapping", "cells" })
  {
    vtkNew<vtkPolyData> surface;
    surface->ShallowCopy(this->Sphere->GetOutput());
    vtkNew<vtkFloatArray> values;
    values->SetNumberOfTuples(way == "cells" ? surface->GetNumberOfCells() : surface->GetNumberOfPoints());
    way == "cells" ? surface->GetCellData()->SetScalars(values) : surface->GetPointData()->SetScalars(values);
    this->Mapper->SetInputData(surface);
    this->Mapper->SetInterpolateScalarsBeforeMapping(way.size() > 6);
    for (int value = 0; value < 3; ++value)
    {
      values->FillValue(static_cast<float>(value));
      values->Modified();
      surface->Modified();
      vtkSmartPointer<vtkImageData> radiance = this->Capture();
      const std::vector<unsigned char> picture = this->Render(this->Pass);
      for (int k = 0; k < 3; ++k)
      {
        const double c = colours[value][k];
        EXPECT_NEAR(radiance->GetScalarComponentAsDouble(48, 48, 0, k), c, 4e-3) << value << " " << way;
        EXPECT_NEAR(picture[4 * (48 * Size + 48) + k], 255 * std::pow(c, 1 / 2.2), 1.5) << value << " " << way;
      }
    }
  }
}

// Rotation, scales, shear, a matrix of the user's, in parallel and in perspective.
TEST_F(TestGeometriesGL, TransformsNormals)
{
  this->ExpectTransform("as it is", [](vtkTransform*) {});
  this->ExpectTransform("rotated", [](vtkTransform* t) { t->RotateWXYZ(50, 1, 2, 3); });
  this->ExpectTransform("stretched",
    [](vtkTransform* t)
    {
      t->RotateZ(30);
      t->Scale(1.1, 0.5, 0.8);
      t->RotateX(40);
    });
  this->ExpectTransform("sheared",
    [](vtkTransform* t)
    {
      const double shear[16] = { 1, 0.5, 0, 0, 0, 0.8, 0.3, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
      t->Concatenate(shear);
    });
  this->ExpectTransform("off the axis",
    [](vtkTransform* t)
    {
      t->Translate(0.4, -0.3, 0.5);
      t->Scale(0.4, 0.4, 0.4);
    });
}

// A mirrored actor is lit as the same geometry mirrored on the CPU. VTK takes its front faces for back faces, turns its
// normals inside, and lights it from within. Mutants: VTK's text left as it is; the sign of the actor alone, with a
// camera that mirrors.
TEST_F(TestGeometriesGL, LightsMirroredActors)
{
  this->ExpectTransform("x", [](vtkTransform* t) { t->Scale(-1, 1, 1); });
  this->ExpectTransform("y", [](vtkTransform* t) { t->Scale(1, -1, 1); });
  this->ExpectTransform("z", [](vtkTransform* t) { t->Scale(1, 1, -1); });
  this->ExpectTransform("all", [](vtkTransform* t) { t->Scale(-1, -1, -1); });
  this->ExpectTransform("turned",
    [](vtkTransform* t)
    {
      t->RotateWXYZ(50, 1, 2, 3);
      t->Scale(0.6, -1, 0.9);
    });
  // As part of a mirrored assembly, mirrored once more, and not.
  this->Actor->SetUserMatrix(nullptr);
  this->Renderer->RemoveActor(this->Actor);
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(this->Actor);
  assembly->SetScale(-1, 0.8, 1);
  this->Renderer->AddActor(assembly);
  for (double scale : { 1.0, -1.0 })
  {
    this->Actor->SetScale(1, scale, 1);
    this->ExpectEllipsoid("assembly", assembly->GetMatrix());
  }
}

// A mirrored actor with a normal map shows the picture of the same geometry mirrored on the CPU, under VTK's light,
// too. 2: float normals, as bytes. Mutant: the normal turned after the map was read.
TEST_F(TestGeometriesGL, MirrorsNormalMaps)
{
  auto mapped = [this](double sign)
  {
    vtkNew<vtkPolyData> surface;
    surface->DeepCopy(this->Sphere->GetOutput());
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(2);
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    {
      double p[3];
      double n[3];
      surface->GetPoint(i, p);
      surface->GetPointData()->GetNormals()->GetTuple(i, n);
      coordinates->InsertNextTuple2(0.5 + 0.4 * p[0], 0.5 + 0.4 * p[1]);
      p[0] *= sign;
      n[0] *= sign;
      surface->GetPoints()->SetPoint(i, p);
      surface->GetPointData()->GetNormals()->SetTuple(i, n);
    }
    surface->GetPointData()->SetTCoords(coordinates);
    if (sign < 0)
    {
      for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
      {
        surface->GetPolys()->ReverseCellAtId(i);
      }
    }
    vtkNew<vtkPolyDataTangents> tangents;
    tangents->SetInputData(surface);
    tangents->Update();
    return vtkSmartPointer<vtkPolyData>(tangents->GetOutput());
  };
  this->Pass->SetEnvironment(this->Slope);
  this->Slope->SetInputData(MakePanorama(64, [](Vec3 d) { return RGB{ 1 + d.x, 1 + d.y, 1 + d.z }; }));
  this->Renderer->AddLight(this->Light);
  this->Actor->GetProperty()->SetColor(0.4, 0.4, 0.4);
  this->Actor->GetProperty()->SetNormalTexture(MakeTexture(false,
    [](int i, int j) {
      return RGB{ 0.35 + 0.1 * (i % 4), 0.35 + 0.1 * (j % 4), 0.95 };
    }));
  this->Mapper->SetInputData(mapped(-1));
  const std::vector<unsigned char> truth = this->Render(this->Pass);
  this->Mapper->SetInputData(mapped(1));
  const std::vector<unsigned char> unmirrored = this->Render(this->Pass);
  this->Actor->SetScale(-1, 1, 1);
  const std::vector<unsigned char> picture = this->Render(this->Pass);
  int different = 0;
  for (int j = 0; j < Size; ++j)
  {
    for (int i = 0; i < Size; ++i)
    {
      const int at = 4 * (j * Size + i);
      if (std::hypot(i - 47.5, j - 47.5) < 40) // the silhouette's pixels differ by rounding of positions
      {
        different += std::abs(unmirrored[at] - truth[at]) > 20;
        for (int k = 0; k < 3; ++k)
        {
          ASSERT_NEAR(picture[at + k], truth[at + k], 2) << i << " " << j;
        }
      }
    }
  }
  EXPECT_GT(different, 500); // or the test would show nothing
}

// From within, the sphere's back faces are lit on the side that is seen. Mutant: no turn of the normal.
TEST_F(TestGeometriesGL, LightsBackFaces)
{
  vtkNew<vtkTransform> large;
  large->Scale(6, 6, 6);
  this->Actor->SetScale(6);
  this->ExpectEllipsoid("from within", large->GetMatrix(), {}, 6e-3, true);
  this->Actor->SetScale(-6, 6, 6);
  vtkNew<vtkTransform> mirrored;
  mirrored->Scale(-6, 6, 6);
  this->ExpectEllipsoid("mirrored, from within", mirrored->GetMatrix(), {}, 6e-3, true);
  this->Actor->SetScale(6);
  this->ExpectFurnace("from within", Size * Size);
}

// A scene a million away from the origin, and scenes a million times smaller and larger, are lit alike. 2e-2: what is
// left of float positions, in the first. Mutants: directions from positions of the world; a normal of length 1e6 or
// 1e-6 not made unit.
TEST_F(TestGeometriesGL, LightsFarSmallAndLargeScenes)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  const double far = 1e6;
  vtkNew<vtkTransform> moved;
  moved->Translate(far, far, far);
  camera->SetFocalPoint(far, far, far);
  camera->SetPosition(far, far, far + 4);
  this->Actor->SetPosition(far, far, far);
  this->ExpectEllipsoid("an actor far away", moved->GetMatrix(), { far, far, far });
  this->Actor->SetPosition(0, 0, 0);
  this->Sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  this->Sphere->SetCenter(far, far, far);
  this->Sphere->Update();
  vtkOpenGLPolyDataMapper::SafeDownCast(this->Mapper)
    ->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::ALWAYS_AUTO_SHIFT_SCALE);
  this->ExpectEllipsoid("points far away", moved->GetMatrix(), { far, far, far }, 2e-2);
  this->Sphere->SetCenter(0, 0, 0);
  this->Sphere->Update();
  camera->SetFocalPoint(0, 0, 0);
  for (double scale : { 1e-6, 1e6 })
  {
    this->Actor->SetScale(scale);
    camera->SetPosition(0, 0, 4 * scale);
    camera->SetClippingRange(0.1 * scale, 20 * scale);
    vtkNew<vtkTransform> unit; // what the camera sees is the same
    this->ExpectEllipsoid(scale < 1 ? "small" : "large", unit->GetMatrix());
    this->ExpectFurnace(scale < 1 ? "small" : "large", 2000);
  }
}

// A camera whose user view transform turns the picture by 90 degrees shows what a rolled camera shows; one that mirrors
// it shows the mirror image of the scene, its background, too. 1: bytes. Mutant: the actor's sign alone.
TEST_F(TestGeometriesGL, FollowsUserViewTransforms)
{
  this->Slope->SetInputData(MakePanorama(64,
    [](Vec3 d) {
      return RGB{ 0.5 + 0.3 * d.x, 0.5 + 0.3 * d.y, 0.5 + 0.3 * d.z };
    }));
  this->Pass->SetEnvironment(this->Slope);
  this->Pass->BackgroundVisibleOn();
  this->Actor->SetScale(0.9, 0.5, 0.7);
  this->Actor->RotateZ(20);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(0.4, 0.3, 4);
  const std::vector<unsigned char> plain = this->Render(this->Pass);
  vtkNew<vtkTransform> user;
  user->RotateZ(90);
  camera->SetUserViewTransform(user);
  const std::vector<unsigned char> turned = this->Render(this->Pass);
  camera->SetUserViewTransform(nullptr);
  camera->Roll(90);
  const std::vector<unsigned char> rolled = this->Render(this->Pass);
  camera->Roll(-90);
  vtkNew<vtkTransform> mirror;
  mirror->Scale(-1, 1, 1);
  camera->SetUserViewTransform(mirror);
  const std::vector<unsigned char> mirrored = this->Render(this->Pass);
  camera->SetUserViewTransform(nullptr);
  int wrongTurn = 0;
  int wrongMirror = 0;
  for (int j = 0; j < Size; ++j)
  {
    for (int i = 0; i < Size; ++i)
    {
      const int at = 4 * (j * Size + i);
      const int other = 4 * (j * Size + Size - 1 - i);
      wrongTurn += std::abs(turned[at] - rolled[at]) > 1 || std::abs(turned[at + 1] - rolled[at + 1]) > 1;
      wrongMirror += std::abs(mirrored[at] - plain[other]) > 1 || std::abs(mirrored[at + 1] - plain[other + 1]) > 1;
    }
  }
  EXPECT_LE(wrongTurn, 20); // pixels on the silhouette may fall to either side
  EXPECT_LE(wrongMirror, 20);
}

// In white light white surfaces show 1 whatever their textures say of roughness, metallic and normals; emission adds,
// occlusion takes away, an albedo of its texture shows. Clipped away is what a plane says.
TEST_F(TestGeometriesGL, LightsTexturesAndClippedSurfaces)
{
  vtkNew<vtkPolyData> surface;
  surface->ShallowCopy(this->Sphere->GetOutput());
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    double p[3];
    surface->GetPoint(i, p);
    coordinates->InsertNextTuple2(0.5 + 0.4 * p[0], 0.5 + 0.4 * p[1]);
  }
  surface->GetPointData()->SetTCoords(coordinates);
  vtkNew<vtkPolyDataTangents> tangents;
  tangents->SetInputData(surface);
  tangents->Update();
  this->Mapper->SetInputData(tangents->GetOutput());
  vtkProperty* property = this->Actor->GetProperty();
  property->SetRoughness(1);
  this->Pass->GetLighting()->HorizonOcclusionOff(); // which darken
  this->Pass->GetLighting()->SpecularOcclusionOff();
  property->SetORMTexture(MakeTexture(false, [](int i, int j) { return RGB{ 1, i / 7.0, j / 7.0 }; }));
  this->ExpectFurnace("roughness and metallic", 2000, 1.0, 4e-3);
  property->SetNormalTexture(MakeTexture(false,
    [](int i, int j) {
      return RGB{ 0.45 + 0.03 * (i % 4), 0.45 + 0.03 * (j % 4), 0.98 };
    }));
  this->ExpectFurnace("normals", 2000, 1.0, 4e-3);
  property->SetEmissiveTexture(MakeTexture(true, [](int, int) { return RGB{ 1, 1, 1 }; }));
  property->SetEmissiveFactor(0.5, 0.5, 0.5);
  this->ExpectFurnace("emission", 2000, 1.5, 4e-3);
  property->SetEmissiveFactor(0, 0, 0);
  property->RemoveTexture("materialTex");
  property->SetORMTexture(MakeTexture(false, [](int, int) { return RGB{ 0.6, 0.5, 1 }; }));
  this->ExpectFurnace("occlusion", 2000, 0.6, 4e-3);
  property->RemoveTexture("materialTex");
  property->SetMetallic(0);
  property->SetBaseIOR(1);
  property->SetBaseColorTexture(MakeTexture(true, [](int, int) { return RGB{ 0.4, 0.4, 0.4 }; }));
  this->ExpectFurnace("albedo", 2000, std::pow((0.4 + 0.055) / 1.055, 2.4), 4e-3); // IEC 61966-2-1
  property->RemoveTexture("albedoTex");
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0, 0, -1);
  plane->SetOrigin(0, 0, 0.5);
  this->Mapper->AddClippingPlane(plane);
  this->ExpectFurnace("clipped: its inner side shows", 2000);
}

// Hardware selection of cells and of points, and the pickers, find with the pass what they find without, and bake
// nothing.
TEST_F(TestGeometriesGL, SelectsTheSame)
{
  auto select = [this](int field)
  {
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(this->Renderer);
    selector->SetArea(30, 30, 50, 50);
    selector->SetFieldAssociation(field);
    vtkSmartPointer<vtkSelection> selection;
    selection.TakeReference(selector->Select());
    std::vector<vtkIdType> ids;
    for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
    {
      auto* list = vtkIdTypeArray::SafeDownCast(selection->GetNode(i)->GetSelectionList());
      ids.insert(ids.end(), list->GetPointer(0), list->GetPointer(0) + list->GetNumberOfValues());
    }
    return ids;
  };
  auto pick = [this]
  {
    vtkNew<vtkCellPicker> cell;
    cell->Pick(40, 50, 0, this->Renderer);
    vtkNew<vtkPropPicker> prop;
    prop->Pick(40, 50, 0, this->Renderer);
    double* p = prop->GetPickPosition();
    return std::make_tuple(cell->GetCellId(), cell->GetActor(), prop->GetActor(), p[0], p[1], p[2]);
  };
  for (bool rendered : { false, true })
  {
    for (int field : { vtkDataObject::FIELD_ASSOCIATION_CELLS, vtkDataObject::FIELD_ASSOCIATION_POINTS })
    {
      this->Render(nullptr);
      const std::vector<vtkIdType> own = select(field);
      const auto picked = pick();
      this->Renderer->SetPass(this->Pass);
      if (rendered)
      {
        this->Window->Render();
      }
      const int builds = this->Pass->GetLighting()->GetSpecularChain()->GetNumberOfBuilds();
      EXPECT_EQ(select(field), own);
      EXPECT_EQ(pick(), picked);
      EXPECT_GT(own.size(), 50u);
      EXPECT_EQ(std::get<1>(picked), this->Actor.Get());
      if (rendered || field == vtkDataObject::FIELD_ASSOCIATION_CELLS) // that of points begins with a frame, in VTK
      {
        EXPECT_EQ(this->Pass->GetLighting()->GetSpecularChain()->GetNumberOfBuilds(), builds);
      }
      this->Renderer->SetPass(nullptr);
    }
  }
}

// A selection right after the light was released, and one in a window that the pass never drew in, find the actor, too.
// Mutant: textures of the other context bound for it.
TEST_F(TestGeometriesGL, SelectsBeforeTheFirstFrame)
{
  auto select = [](vtkRenderer* renderer)
  {
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(renderer);
    selector->SetArea(0, 0, Size - 1, Size - 1);
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
    vtkSmartPointer<vtkSelection> selection;
    selection.TakeReference(selector->Select());
    return selection->GetNumberOfNodes();
  };
  this->Pass->BackgroundVisibleOn();
  this->Render(this->Pass);
  EXPECT_EQ(select(this->Renderer), 1u);
  this->Pass->ReleaseGraphicsResources(this->Window);
  EXPECT_EQ(select(this->Renderer), 1u);
  const std::vector<unsigned char> first = this->Render(this->Pass);
  this->Renderer->SetPass(nullptr);
  vtkNew<vtkIBLOffscreenWindow> window;
  window->DebugContextOn();
  window->SetSize(Size, Size);
  this->Window->RemoveRenderer(this->Renderer);
  window->AddRenderer(this->Renderer);
  this->Renderer->SetPass(this->Pass);
  EXPECT_EQ(select(this->Renderer), 1u);
  window->Render();
  EXPECT_TRUE(GetPicture(window) == first);
  EXPECT_EQ(window->GetNumberOfHighSeverityMessages(), 0);
  window->RemoveRenderer(this->Renderer);
}

// Labels, slices and volumes show no lit surface, so nothing is made for them, alone or in an assembly. Mutant: all
// that is no actor taken for a surface of every roughness.
TEST_F(TestGeometriesGL, NeedsNothingForLabelsAndSlices)
{
  vtkNew<vtkBillboardTextActor3D> billboard;
  vtkNew<vtkTextActor3D> text;
  vtkNew<vtkImageSlice> slice;
  vtkNew<vtkVolume> volume;
  vtkNew<vtkPropAssembly> assembly;
  assembly->AddPart(text);
  assembly->AddPart(slice);
  vtkProp* props[] = { billboard, text, slice, volume, assembly, this->Actor };
  EXPECT_TRUE(vtkIBLSceneNeeds::Of(props, 5).IsNothing());
  EXPECT_EQ(vtkIBLSceneNeeds::Of(props, 6).MinimumRoughness, vtkIBLBRDFTable::GetNarrowestLobe(0.5)); // the actor's
  EXPECT_EQ(vtkIBLSceneNeeds::Of(props, 6).MaximumRoughness, 0.5);
}

// What is not PBR is VTK's, with normals and without. Mutant: a mirrored Phong actor mended.
TEST_F(TestGeometriesGL, LeavesOtherInterpolationsToVTK)
{
  this->Renderer->AddLight(this->Light);
  vtkNew<vtkActor> pbr;             // so that there is something to light
  vtkNew<vtkPolyDataMapper> mapper; // its own: what is flat takes the normals out of a shared one
  mapper->SetInputData(this->Sphere->GetOutput());
  pbr->SetMapper(mapper);
  pbr->SetScale(0.2);
  pbr->SetPosition(0.9, 0.9, 0);
  MakeWhite(pbr->GetProperty());
  this->Renderer->AddActor(pbr);
  this->White->SetIntensity(0);
  for (int interpolation : { VTK_FLAT, VTK_GOURAUD, VTK_PHONG })
  {
    for (double sign : { 1.0, -1.0 })
    {
      this->Actor->SetScale(sign, 1, 1);
      this->Actor->GetProperty()->SetInterpolation(interpolation);
      const std::vector<unsigned char> own = this->Render(nullptr);
      EXPECT_TRUE(this->Render(this->Pass) == own) << interpolation << " " << sign;
    }
  }
}
