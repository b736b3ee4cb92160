#pragma once

#include "sim/links/fix.h"
#include "sim/links/wire_bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace octant::sim::links {

/// Lines of numbers under named columns, as any script can write them: first a line of names, then one line per fix,
/// separated by commas, tabs or semicolons. Required: alt_m and either lat_deg and lon_deg or north_m and east_m (from
/// the origin of the flight). Optional: t_s (clock of the sender), agl_m, roll_deg, pitch_deg, yaw_deg, v_north_mps,
/// v_east_mps, v_up_mps, id (an integer for each aircraft). Other columns are ignored.
class NamedColumns {
public:
    /// Longest accepted line, bytes.
    static constexpr std::size_t longest_line = 2048;

    /// Reads a line. A line whose first field is not a number is a line of names; the first line must be one. Sets
    /// `fix` if the result has no fault; lines of names are Unused.
    DecodeResult take(Bytes line, Fix& fix);

    /// Message about a line.
    static std::string text_of(const DecodeResult& result);

private:
    static constexpr std::size_t quantities = 14;

    DecodeResult take_names(std::string_view line);
    Fix fix_of(const std::array<double, quantities>& values) const;

    bool has(std::size_t quantity) const { return fields_[quantity].has_value(); }

    bool named_ = false;
    char separator_ = ',';
    std::size_t count_ = 0;
    std::array<std::optional<std::size_t>, quantities> fields_; ///< of each quantity
};

} // namespace octant::sim::links
