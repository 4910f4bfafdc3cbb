// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLSceneNeeds
 * @brief what of an environment's light a scene can show at all: the rest is not made
 *
 * Cheap enough for every frame: it looks at the properties of visible props, at no geometry and no texel.
 */
#ifndef vtkIBLSceneNeeds_h
#define vtkIBLSceneNeeds_h

#include "vtkIBLModule.h" // For export macro

class vtkProp;

struct VTKIBL_EXPORT vtkIBLSceneNeeds
{
  /**
   * There is a surface to light: all but the background read irradiance.
   */
  bool Irradiance = false;

  ///@{
  /**
   * Reflections of roughness from minimum to maximum, in [0, 1], the background's blur among them; minimum above
   * maximum: none.
   */
  double MinimumRoughness = 2.0;
  double MaximumRoughness = -1.0;
  ///@}

  ///@{
  /**
   * Some surface may be metal in part, or dielectric in part.
   */
  bool Metal = false;
  bool Dielectric = false;

  /**
   * Some metal may have an edge tint other than white.
   */
  bool EdgeTint = false;
  ///@}

  /**
   * The radiance cube itself is read, with its mip levels: by samples, or by what shows the sky small.
   */
  bool RadianceCube = false;

  /**
   * Whether a reflection is sharper than the first layer, so that the mirror is read.
   */
  bool NeedsMirror() const;

  bool HasReflections() const { return this->MinimumRoughness <= this->MaximumRoughness; }
  bool IsNothing() const { return !this->Irradiance && !this->HasReflections() && !this->RadianceCube; }
  void AddRoughness(double minimum, double maximum);
  void Add(const vtkIBLSceneNeeds& other);

  /**
   * What any surface may need.
   */
  static vtkIBLSceneNeeds Everything();

  /**
   * What visible actors of `props` with lighting on need, those of PBR interpolation or all. A texture of roughness and
   * metallic counts as all of [0, 1], and so does a prop whose kind is not known.
   */
  static vtkIBLSceneNeeds Of(vtkProp* const* props, int count, bool nonPBR = false);
};

#endif
