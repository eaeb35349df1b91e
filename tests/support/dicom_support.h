// SPDX-License-Identifier: MIT
// dicom_support: small DICOM slices, byte by byte.
#pragma once

#include <string>

namespace tool {

// CT Image Storage, explicit VR little endian: 2 x 2 voxels of 16 bits, 4 k + 1 to 4 k + 4, at z = 2 k mm.
std::string dicom_slice(int k);

}  // namespace tool
