// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLIrradiance
 * @brief diffuse light as nine spherical-harmonic coefficients
 *
 * Projects the radiance cube on the real orthonormal harmonics of bands 0 to 2 with each texel's exact solid angle
 * (rows in float on the GPU, rows added in double), and convolves with the clamped cosine (pi, 2 pi/3, pi/4).
 * Ramamoorthi & Hanrahan 2001. Index l (l + 1) + m, no Condon-Shortley sign: 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 -
 * y^2.
 */
#ifndef vtkIBLIrradiance_h
#define vtkIBLIrradiance_h

#include "vtkIBLStage.h"
#include "vtkSmartPointer.h"

#include <memory> // For std::unique_ptr

class vtkIBLCubeMap;

class VTKIBL_EXPORT vtkIBLIrradiance : public vtkIBLStage
{
public:
  static vtkIBLIrradiance* New();
  vtkTypeMacro(vtkIBLIrradiance, vtkIBLStage);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The stage to the left.
   */
  void SetCubeMap(vtkIBLCubeMap* cubeMap);
  vtkIBLCubeMap* GetCubeMap() const;
  ///@}

  /**
   * Coefficient `index` in [0, 8] of radiance (the cosine is not convolved in), as RGB. Zero before the first Update().
   */
  void GetRadianceCoefficient(int index, double rgb[3]) const;

  /**
   * Irradiance [radiance x sr] on a surface whose unit normal is `normal`, in the environment's own frame. Never
   * negative.
   */
  void GetIrradiance(const double normal[3], double rgb[3]) const;

  /**
   * Irradiance over pi as a polynomial in the normal (x, y, z): the nine RGB factors of 1, y, z, x, xy, yz, 3z^2 - 1,
   * xz, x^2 - y^2. What the shader takes.
   */
  void GetPolynomial(float factors[9][3]) const;

protected:
  vtkIBLIrradiance();
  ~vtkIBLIrradiance() override;

  bool UpdateInput(vtkOpenGLRenderWindow* window, vtkMTimeType& inputTime) override;
  vtkTypeInt64 Build(vtkOpenGLRenderWindow* window) override;
  void Release() override;

private:
  vtkIBLIrradiance(const vtkIBLIrradiance&) = delete;
  void operator=(const vtkIBLIrradiance&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
  vtkSmartPointer<vtkIBLCubeMap> CubeMap;
  double Coefficients[9][3] = {};
};

#endif
