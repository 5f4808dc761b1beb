#pragma once
#include <filesystem>
#include <string>

#include "output/result_file.hpp"

namespace vitrum::output {

/// The XDMF text that lets visualisation programs open `result` as a time series of points. Outputs without
/// positions are left out. The data stay in result.h5, which must lie in the same directory.
///
/// Fields with two components are written as `Vector` with two columns: the three XDMF readers of
/// ParaView 5.11 accept that (its default reader adds the third component, which glyphs need), while
/// functions and hyperslabs stop two of the three. Other fields with several components are `Matrix`. The
/// points are listed explicitly, because the Xdmf3 readers draw none else.
std::string xdmf_text(const ResultFile& result);

/// Writes result.xdmf beside result.h5, atomically. Throws FileError.
void write_xdmf(const ResultFile& result);

}  // namespace vitrum::output
