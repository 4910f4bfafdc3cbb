// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLBackground
 * @brief the environment as seen behind the scene, drawn at the far plane
 *
 * A prop, so that a chain of render passes draws it where it draws opaque geometry, after its own clear. Made and used
 * by vtkIBLRenderPass.
 */
#ifndef vtkIBLBackground_h
#define vtkIBLBackground_h

#include "vtkProp.h"

#include <memory> // For std::unique_ptr

class vtkIBLLighting;

class vtkIBLBackground : public vtkProp
{
public:
  static vtkIBLBackground* New();
  vtkTypeMacro(vtkIBLBackground, vtkProp);

  void SetLighting(vtkIBLLighting* lighting) { this->Lighting = lighting; }
  /// 0: the cube map itself; above: as a surface of this perceptualRoughness mirrors it.
  void SetBlur(double blur) { this->Blur = blur; }
  /// Mip level of the cube map that is shown without blur.
  void SetSharpLevel(double level) { this->SharpLevel = level; }
  void SetDisplayEncoding(bool encode) { this->DisplayEncoding = encode; }
  /// Of a picture that is there already, by its alpha; not of what will be drawn, by its depth.
  void SetBehindPicture(bool behind) { this->BehindPicture = behind; }

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkIBLBackground();
  ~vtkIBLBackground() override;

private:
  vtkIBLBackground(const vtkIBLBackground&) = delete;
  void operator=(const vtkIBLBackground&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
  vtkIBLLighting* Lighting = nullptr; // owned by the pass that owns this
  double Blur = 0.0;
  double SharpLevel = 0.0;
  bool DisplayEncoding = true;
  bool BehindPicture = false;
};

#endif
