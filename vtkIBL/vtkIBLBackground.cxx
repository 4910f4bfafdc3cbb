// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLBackground.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLGL.h"
#include "vtkIBLLighting.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"

#include <cmath>
#include <stdexcept>

vtkStandardNewMacro(vtkIBLBackground);

struct vtkIBLBackground::Internals
{
  vtkIBLGL::Program Program;
  vtkIBLGL::VertexArray NoVertices;
};

namespace
{
// View-space x and y at depth 1 of a point of the picture: (ndc + shift) * scale.
void GetViewRays(vtkRenderer* renderer, glm::vec2& scale, glm::vec2& shift)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const double aspect = renderer->GetTiledAspectRatio();
  if (camera->GetParallelProjection())
  {
    // All rays of a parallel projection look at one point of the environment; show what a perspective of the same view
    // angle would.
    const double half = std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
    scale = glm::vec2(half * aspect, half);
    shift = glm::vec2(0.0f);
    return;
  }
  vtkMatrix4x4* projection = camera->GetProjectionTransformMatrix(aspect, -1, 1);
  scale = glm::vec2(1.0 / projection->GetElement(0, 0), 1.0 / projection->GetElement(1, 1));
  shift = glm::vec2(projection->GetElement(0, 2), projection->GetElement(1, 2));
}
}

vtkIBLBackground::vtkIBLBackground()
  : Internal(new Internals)
{
}

vtkIBLBackground::~vtkIBLBackground() = default;

int vtkIBLBackground::RenderOpaqueGeometry(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  auto* window = renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
  if (!window || renderer->GetSelector())
  {
    return 0;
  }
  try
  {
    using namespace vtkIBLGL;
    Internals& gl = *this->Internal;
    if (!gl.Program.IsIn(window))
    {
      gl = Internals(); // in whichever context it was
      window->MakeCurrent();
      gl.Program = Program::Draw(window, "vtkIBLBackgroundVS.glsl", "vtkIBLBackgroundFS.glsl");
      gl.NoVertices = VertexArray::Make(window);
    }
    this->Lighting->SetLayerParameters(gl.Program);
    this->Lighting->SetLampParameters(gl.Program, this->Blur);
    gl.Program.Set("blur", float(this->Blur));
    gl.Program.Set("sharpLevel", float(this->SharpLevel));

    glm::vec2 scale;
    glm::vec2 shift;
    GetViewRays(renderer, scale, shift);
    gl.Program.Set("viewScale", scale);
    gl.Program.Set("viewShift", shift);
    glm::mat3 environmentFromView;
    this->Lighting->GetEnvironmentFromView(renderer, &environmentFromView[0].x);
    gl.Program.Set("environmentFromView", environmentFromView);
    double rgb[3];
    this->Lighting->GetEnvironment()->GetRadianceScale(rgb);
    gl.Program.Set("radianceScale", glm::vec3(rgb[0], rgb[1], rgb[2]));
    gl.Program.Set("encodingExponent", this->DisplayEncoding ? 1.0f / 2.2f : 1.0f);

    DrawScreen(
      window, gl.Program, gl.NoVertices, GL_FALSE, this->BehindPicture ? GL_ALWAYS : GL_LEQUAL, this->BehindPicture);
    CheckErrors("drawing the background");
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkIBLBackground::ReleaseGraphicsResources(vtkWindow*)
{
  *this->Internal = Internals();
}
