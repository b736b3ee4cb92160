#pragma once

#include "sim/links/fix.h"
#include "sim/links/wire_bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace octant::sim::links {

/// Lines of numbers under named columns, as any script can write them: first the names, then a line a fix, parted by
/// commas or tabs. Places are lat_deg and lon_deg, or north_m and east_m from the flight's place; alt_m must be there.
/// As there may be: t_s (the sender's clock), agl_m, roll_deg, pitch_deg, yaw_deg, v_north_mps, v_east_mps, v_up_mps,
/// id (a whole number for each aircraft). Other columns are passed over.
class NamedColumns {
public:
    /// Longest line that is taken, bytes.
    static constexpr std::size_t longest_line = 2048;

    /// Takes a line. A line that holds no number in its first field is one of names; the first line must be one. `fix`
    /// is set where the result is without fault; lines of names are Unused.
    DecodeResult take(Bytes line, Fix& fix);

    /// What a person should be told of a line.
    static std::string text_of(const DecodeResult& result);

private:
    static constexpr std::size_t quantities = 15;

    DecodeResult take_names(std::string_view line);
    Fix fix_of(const std::array<double, quantities>& values) const;

    bool has(std::size_t quantity) const { return fields_[quantity] >= 0; }

    bool named_ = false;
    char separator_ = ',';
    std::size_t count_ = 0;
    std::array<int, quantities> fields_{}; ///< of each quantity; -1 = not there
};

} // namespace octant::sim::links
