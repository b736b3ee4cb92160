#include "visuals/terrain/error_codes.h"
#include "visuals/terrain/error_encoder.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <limits>

namespace octant::visuals::terrain {

namespace {

float step_to(const ErrorCodes& codes, int code) {
    return codes.metres(static_cast<std::uint8_t>(code)) / codes.metres(static_cast<std::uint8_t>(code - 1));
}

} // namespace

TEST_CASE("an error's code is the smallest that is not below it") {
    for (const ErrorCodes& codes :
        {ErrorCodes::legacy(), ErrorCodes::for_height_unit(0x1p-4), ErrorCodes::for_height_unit(0x1p-12)}) {
        CHECK(codes.metres(0) == 0.0F);
        CHECK(codes.code_of(0.0F) == 0);
        CHECK(codes.code_of(std::numeric_limits<float>::min()) == 1);
        CHECK(codes.code_of(1e9F) == 255);
        for (int code = 1; code < 256; ++code) {
            const float error_m = codes.metres(static_cast<std::uint8_t>(code));
            const float below_m = codes.metres(static_cast<std::uint8_t>(code - 1));
            CHECK(below_m < error_m);
            CHECK(codes.code_of(error_m) == code);
            CHECK(codes.code_of(0.5F * (error_m + below_m)) == code);
        }
    }
}

TEST_CASE("the codes of all grounds are those of files of versions 1 to 4") {
    const ErrorCodes codes = ErrorCodes::legacy();
    CHECK(codes.metres(1) == 0.01F);
    CHECK(codes.metres(255) == Approx(12'126.45));
    for (int code = 2; code < 256; ++code) { CHECK(step_to(codes, code) == Approx(1.0567)); }
}

TEST_CASE("a ground's own codes reach beyond what it spans, in fine steps but at the ends") {
    const ErrorCodes codes = ErrorCodes::for_height_unit(0.125);
    CHECK(codes.metres(1) == 0.25F * 0.125F);
    CHECK(codes.metres(255) >= 2.0F * 65'000.0F * 0.125F);
    for (int code = 2; code < 256; ++code) {
        const float error_m = codes.metres(static_cast<std::uint8_t>(code));
        const bool fine = error_m > 4.01F * 0.125F && error_m < 8192.1F * 0.125F;
        CHECK(step_to(codes, code) < (fine ? 1.0363F : 1.1488F));
        CHECK(ErrorCodes::for_height_unit(0.25).metres(static_cast<std::uint8_t>(code)) == 2.0F * error_m);
    }
}

TEST_CASE("the table of codes agrees with the search") {
    for (const ErrorCodes& codes : {ErrorCodes::legacy(), ErrorCodes::for_height_unit(0x1p-4)}) {
        const ErrorEncoder coder(codes, 0.25);
        CHECK(coder.code_of(0.0F) == 0);
        for (float steps = 1e-3F; steps < 1e6F; steps *= 1.003F) {
            CHECK(coder.code_of(steps) == codes.code_of(0.25F * steps));
        }
        for (int code = 1; code < 256; ++code) {
            const float error_m = codes.metres(static_cast<std::uint8_t>(code));
            CHECK(coder.code_of(4.0F * error_m) == code);
            CHECK(coder.steps_of(static_cast<std::uint8_t>(code)) == 4.0F * error_m);
        }
    }
}

} // namespace octant::visuals::terrain
