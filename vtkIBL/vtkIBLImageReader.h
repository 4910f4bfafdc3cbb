// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIBLImageReader_h
#define vtkIBLImageReader_h

#include "vtkIBLModule.h" // for VTKIBL_EXPORT
#include "vtkImageAlgorithm.h"

#include <exception> // for Fail

/**
 * Reads the light of an environment from any picture that OpenImageIO reads (.exr .hdr .tif .png .jpg ...).
 *
 * The output is a vtkImageData of three floats a pixel, the array "Radiance": linear red, green and blue, spacing 1. It
 * is either of these two, and its dimensions tell which:
 *
 * - **A panorama** (equirectangular, "lat-long"), W x H x 1. The direction d of the point (u, v) in [0,1]^2 is
 *       u = atan2(d.z, d.x) / 2pi + 1/2,   v = asin(d.y) / pi + 1/2.
 *   Row 0 is the picture's bottom edge (v = 0, straight down), column 0 its left edge (u = 0, towards -x); its centre
 * is +x.
 * - **A cube**, n x n x 6, slices +X -X +Y -Y +Z -Z. Column 0 is at s = -1 and row 0 at t = -1, where the direction is
 *       +X (1,-t,-s)  -X (-1,-t,s)  +Y (s,1,t)  -Y (s,-1,-t)  +Z (s,-t,1)  -Z (-s,-t,-1),
 *   OpenGL's own. Seen from the inside of a right-handed world, as a panorama is, these faces are mirror images.
 *
 * Either way a pixel stands for the middle of its cell: pixel i of n lies at (i + 1/2) / n.
 *
 * **Layouts.** Auto takes a picture by its shape: 2n x n (within one pixel) is a panorama; 6n x n and n x 6n are the
 * six faces in OpenGL's order, each with s to the right and t down; 4n x 3n and 3n x 4n are crosses,
 *
 *         .  +Y  .   .          .  +Y  .
 *        -X  +Z  +X  -Z        -X  +Z  +X
 *         .  -Y  .   .          .  -Y  .
 *                               .  -Z  .     (-Z turned by 180 degrees)
 *
 * **OpenEXR environment maps.** Auto lets the `envmap` attribute go before the shape. OpenEXR looks along +Z at the
 * centre of a panorama, and here it is +x: x = Z, y = Y, z = -X. Its cubes are unmirrored views of that frame; faces
 * are re-ordered and turned to match. OpenEXR puts the first and the last pixel *on* the border of a face or a panorama
 * (poles and seam are pixels), so texels are interpolated linearly, by up to half a pixel at the borders, to the middle
 * of cells. Its mapping is defined on the data window. SetLayout(LayoutEquirectangular or LayoutCube) takes such a file
 * as one without the attribute.
 *
 * **Channels.** R, G, B by name, whatever their order; else the first three; one or two channels (grey, alpha) give
 * grey. Alpha is dropped: OpenEXR's colours are premultiplied, which is the light itself, and those of other formats
 * are taken as stored. A layered EXR gives the first layer that has colours; a file of several parts or mipmap levels
 * the first. Primaries are not converted, and the EXIF orientation isn't applied.
 *
 * **Windows.** Of an OpenEXR file without `envmap` the output covers the display window: pixels outside of the data
 * window are black, overscan is cropped.
 *
 * NaN, Inf and negative values pass through as they are. Beware that a mean or an interpolation of texels of which one
 * is NaN is NaN; a later stage counts and cleans.
 *
 * **When it fails,** an error says which file, what is wrong with it and what to do, GetErrorCode() is not
 * vtkErrorCode::NoError, and the output is empty. A read stopped with SetAbortExecute(1), from an observer of
 * ProgressEvent, is no error; its output is empty too, and after SetAbortExecute(0) Update() reads again. Keep a
 * shallow copy of the output if you need the last good one. A file that changed on the disk is read again after
 * Modified().
 */
class VTKIBL_EXPORT vtkIBLImageReader : public vtkImageAlgorithm
{
public:
  static vtkIBLImageReader* New();
  vtkTypeMacro(vtkIBLImageReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The picture's path, in UTF-8. Only regular files, or links to them, are read. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  enum ColorSpaceType
  {
    ColorSpaceAuto,
    ColorSpaceLinear,
    ColorSpaceSRGB
  };

  ///@{
  /**
   * How numbers in the file mean light. Linear: as they are; integers are scaled to [0,1]. SRGB: through sRGB's exact
   * piecewise curve. Auto, the default: SRGB for integers of 8 and 16 bits, unless the file itself says that they are
   * linear (OpenImageIO's "oiio:ColorSpace"; a PNG of gamma 1, a linear DPX), and Linear for all others, whatever they
   * say: what tools write there about floats is often wrong. A linear picture read as SRGB has too dark shadows and too
   * much contrast; an sRGB picture read as Linear is washed out, and lights too brightly.
   */
  vtkSetClampMacro(ColorSpace, int, ColorSpaceAuto, ColorSpaceSRGB);
  vtkGetMacro(ColorSpace, int);
  ///@}

  enum LayoutType
  {
    LayoutAuto,
    LayoutEquirectangular,
    LayoutCube
  };

  ///@{
  /**
   * What the picture shows. Equirectangular takes a picture of any shape as the whole sphere. Cube takes the strips and
   * crosses above, and nothing else. Default: Auto, as above.
   */
  vtkSetClampMacro(Layout, int, LayoutAuto, LayoutCube);
  vtkGetMacro(Layout, int);
  ///@}

  ///@{
  /**
   * The widest output, in pixels: of the panorama, or of one cube face. A wider picture is reduced while it is read, by
   * the smallest integer factor f that is enough, on all threads. Memory is then the output, one band of rows (16 MiB
   * as stored, or one row of tiles), and what OpenImageIO and the decoder hold: 16384 x 8192 takes up to 70 MiB more
   * than the output, 250 MiB with DWAB. A pixel of a panorama is the mean of its f x f pixels by their solid angle, one
   * of a cube face their plain mean. When f is no divisor of the width, the pixels at a cell's border count by their
   * share. Too small blurs mirrors; too large costs memory. Default: 0, never reduce.
   */
  vtkSetClampMacro(MaximumWidth, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumWidth, int);
  ///@}

  ///@{
  /**
   * Refuse a file that declares more pixels than this before anything is allocated for them, so that a damaged or
   * hostile header costs nothing. Default: 201326592, a panorama of 16384 x 8192 and half as much again.
   */
  vtkSetClampMacro(MaximumNumberOfPixels, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(MaximumNumberOfPixels, vtkIdType);
  ///@}

protected:
  vtkIBLImageReader();
  ~vtkIBLImageReader() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkIBLImageReader(const vtkIBLImageReader&) = delete;
  void operator=(const vtkIBLImageReader&) = delete;

  int Fail(vtkInformationVector* outputVector, const std::exception& error);

  char* FileName = nullptr;
  int ColorSpace = ColorSpaceAuto;
  int Layout = LayoutAuto;
  int MaximumWidth = 0;
  vtkIdType MaximumNumberOfPixels = vtkIdType(16384) * 8192 * 3 / 2;
};

#endif
