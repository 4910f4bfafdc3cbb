// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkIBLFuzzSeeds FOLDER: writes FOLDER/pictures and FOLDER/lights, what the fuzzers begin with.
#include "StressFiles.h"

#include "vtkIBLStoredLightFile.h"

#include <exception>
#include <iostream>

int main(int argc, char* argv[])
try
{
  if (argc != 2)
  {
    std::cerr << "Usage: vtkIBLFuzzSeeds FOLDER\n";
    return 2;
  }
  const std::filesystem::path pictures = std::filesystem::path(argv[1]) / "pictures";
  const std::filesystem::path lights = std::filesystem::path(argv[1]) / "lights";
  std::filesystem::create_directories(pictures);
  std::filesystem::create_directories(lights);
  WriteStressFiles(pictures);
  for (int kind = 1; kind < 8; ++kind) // each of the three parts there or not
  {
    vtkIBLStoredLight light;
    light.CubeFaceSize = kind & 1 ? 2 : 0;
    light.SpectrumOrder = kind & 2 ? 1 : -1;
    light.Cube.resize(vtkIBLStoredLight::GetCubeLength(light.CubeFaceSize), 0.5f);
    light.Coefficients.resize(vtkIBLStoredLight::GetCoefficientsLength(light.SpectrumOrder), 0.25f);
    light.BrightTexels.resize(kind & 4 ? 2 : 0);
    vtkIBLWriteStoredLight(lights / (std::to_string(kind) + ".exr"), "key", light);
  }
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << error.what() << "\n";
  return 1;
}
