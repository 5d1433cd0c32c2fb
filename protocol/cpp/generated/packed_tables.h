// Generated from protocol/schema by semblante-codegen-protocol; change the schema, not this.
// clang-format off
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// What the packed form knows beforehand: SPEC.md, "Packed form".
namespace semblante::packed_tables {

/// By FAP: one coded before it that often moves as it does; 0: none.
inline constexpr std::array<std::uint8_t, 69> references = {
    0, 0, 0, 0, 0, 3, 0, 6, 4, 8, 5, 10, 6, 12, 3, 0, 5, 16, 3, 0,
    19, 19, 20, 0, 23, 0, 25, 0, 27, 0, 29, 0, 31, 31, 33, 33, 35, 31, 37, 0,
    39, 6, 41, 0, 0, 0, 44, 0, 0, 0, 0, 4, 5, 6, 53, 51, 55, 52, 57, 12,
    59, 0, 61, 12, 0, 0, 65, 0, 67};

// The first context of each table.
inline constexpr std::size_t join_differs = 0;  ///< a keyframe has history
inline constexpr std::size_t count_differs = 1;  ///< the number of frames of a batch is not that of the batch before
inline constexpr std::size_t count_length = 2;  ///< of that number less 1
inline constexpr std::size_t time_differs = 12;  ///< [first frame of a batch, another][time class]
inline constexpr std::size_t time_sign = 18;  ///< [first frame of a batch, another]
inline constexpr std::size_t time_length = 20;
inline constexpr std::size_t offset_differs = 73;  ///< `time` of the first frame is not 0
inline constexpr std::size_t viseme_differs = 74;  ///< [viseme class]
inline constexpr std::size_t viseme_kind = 80;  ///< [row][4 questions]
inline constexpr std::size_t viseme_second = 92;  ///< [kind - 2]
inline constexpr std::size_t viseme_select = 95;  ///< [node of a tree of four bits]
inline constexpr std::size_t share_differs = 111;  ///< [known, not]
inline constexpr std::size_t share_sign = 113;  ///< [fell or held, rose][known, not]
inline constexpr std::size_t share_length = 117;  ///< [known, not][5]
inline constexpr std::size_t blend_differs = 127;  ///< [`select2` is not 0, is 0]
inline constexpr std::size_t blend_length = 129;
inline constexpr std::size_t expression_differs = 134;  ///< [expression class]
inline constexpr std::size_t expression_kind = 136;  ///< [2 questions]
inline constexpr std::size_t expression_select = 138;  ///< [first, second][node of a tree of three bits]
inline constexpr std::size_t intensity_differs = 154;  ///< [known, new, none][held or unknown, fell, rose]
inline constexpr std::size_t intensity_sign = 163;  ///< likewise
inline constexpr std::size_t intensity_length = 172;  ///< [known, not][5]
inline constexpr std::size_t group_moves = 182;  ///< [group - 2][some, all of its FAPs are still]
inline constexpr std::size_t follower_differs = 200;  ///< [reach of the reference's step, at most 7][reference right, off]
inline constexpr std::size_t follower_sign = 216;  ///< [reference right, off upwards, off downwards]
inline constexpr std::size_t slow_differs = 219;  ///< [pattern][reference still, moves]
inline constexpr std::size_t slow_sign = 247;  ///< likewise
inline constexpr std::size_t slow_more = 275;  ///< [reference still, moves by one, by more][pattern 0, other]
inline constexpr std::size_t level_differs = 281;  ///< [row][reach of the cost, at most 9]
inline constexpr std::size_t level_sign = 331;  ///< [line, shared, hold][reference right, off upwards, off downwards]
inline constexpr std::size_t level_length = 340;  ///< [set][15]
inline constexpr std::size_t top_bit = 595;  ///< [length]
inline constexpr std::size_t second_bit = 612;  ///< [length]
inline constexpr std::size_t size = 629;

/// By context: the probability of a 1 in 4096ths.
inline constexpr std::array<std::uint16_t, size> values = {
    // join_differs
    3008,
    // count_differs
    55,
    // count_length
    3540, 1505, 600, 2048, 2048, 2048, 2048, 2048, 2048, 2048,
    // time_differs
    522, 2094, 2099, 774, 3131, 3136,
    // time_sign
    2043, 2095,
    // time_length
    1042, 2478, 767, 913, 714, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048,
    2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048,
    2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048,
    // offset_differs
    12,
    // viseme_differs
    497, 3284, 4053, 2589, 814, 3692,
    // viseme_kind
    3842, 344, 870, 3983, 2006, 2143, 451, 1575, 2429, 1797, 1897, 1881,
    // viseme_second
    2061, 54, 2449,
    // viseme_select
    2048, 2053, 2279, 1764, 2644, 2135, 2011, 1263, 3936, 1990, 2224, 2011, 1966, 1986, 2234, 187,
    // share_differs
    3625, 4018,
    // share_sign
    3860, 1944, 3233, 2048,
    // share_length
    3684, 3627, 3450, 3039, 2250, 3741, 3807, 3745, 3702, 2560,
    // blend_differs
    3787, 1600,
    // blend_length
    3863, 3713, 3445, 2868, 1022,
    // expression_differs
    56, 3582,
    // expression_kind
    545, 3691,
    // expression_select
    2048, 1230, 1811, 1749, 1372, 2094, 2122, 803, 2048, 300, 337, 1982, 234, 1672, 2258, 1638,
    // intensity_differs
    1396, 2247, 2975, 3890, 2048, 2048, 21, 2048, 2048,
    // intensity_sign
    3599, 2179, 2151, 206, 2048, 2048, 2048, 2048, 2048,
    // intensity_length
    1230, 854, 1328, 2477, 1443, 2882, 2722, 3349, 3452, 2484,
    // group_moves
    492, 51, 440, 1214, 611, 28, 221, 19, 2048, 12, 985, 1113, 402, 12, 13, 12, 2048, 12,
    // follower_differs
    53, 97, 60, 281, 79, 475, 94, 501, 71, 331, 84, 415, 33, 681, 254, 504,
    // follower_sign
    2283, 2515, 1196,
    // slow_differs
    1581, 1453, 1332, 3811, 2503, 3528, 1273, 2854, 3113, 3406, 3224, 3695, 3085, 3390, 2804, 3782, 2020, 3489, 491, 2952,
    1525, 3022, 2535, 3852, 2504, 3426, 2976, 3523,
    // slow_sign
    1960, 1047, 374, 3103, 2302, 1474, 321, 1563, 160, 2476, 1011, 1965, 620, 1828, 1384, 934, 1202, 2036, 680, 1103,
    391, 2704, 1152, 1394, 179, 1263, 76, 1310,
    // slow_more
    1115, 676, 3309, 1885, 3193, 2400,
    // level_differs
    1789, 2494, 2868, 3471, 3707, 3659, 3778, 3587, 3464, 3754, 2048, 1654, 2025, 2728, 3278, 3215, 2342, 1539, 1723, 2088,
    2048, 2595, 3198, 3625, 3694, 3935, 3241, 2980, 3459, 3361, 2885, 3400, 3483, 3666, 3758, 3799, 3205, 3708, 3102, 2048,
    3215, 3505, 3650, 3693, 3768, 3843, 3979, 3979, 3998, 3686,
    // level_sign
    2017, 2020, 2060, 2225, 2410, 1737, 2112, 2206, 1923,
    // level_length
    2245, 1998, 929, 623, 1452, 1814, 2014, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2169, 1858, 836, 681, 735,
    1877, 1950, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2682, 2007, 950, 995, 1401, 1426, 577, 2048, 2048, 2048,
    2048, 2048, 2048, 2048, 2048, 3128, 2182, 814, 517, 919, 1826, 1163, 1836, 1781, 2048, 2048, 2048, 2048, 2048, 2048,
    3350, 2487, 1257, 955, 1428, 534, 1139, 1982, 2130, 1781, 2048, 2048, 2048, 2048, 2048, 3604, 3345, 2741, 2048, 887,
    974, 880, 1124, 2048, 1862, 2048, 2048, 2048, 2048, 2048, 3808, 3709, 3433, 2767, 1625, 654, 1911, 551, 2731, 1365,
    2048, 2048, 2048, 2048, 2048, 3992, 3870, 3627, 3241, 2581, 1182, 803, 771, 2222, 1517, 2048, 2048, 2048, 2048, 2048,
    4029, 4035, 3840, 3771, 3232, 3063, 1139, 565, 2926, 1024, 2048, 2048, 2048, 2048, 2048, 4039, 4030, 4003, 3867, 3886,
    3449, 3312, 2357, 848, 529, 1982, 2048, 2048, 2048, 2048, 1339, 2222, 659, 1964, 2358, 2081, 1832, 2028, 2048, 2048,
    2048, 2048, 2048, 2048, 2048, 1482, 1609, 1847, 1375, 2795, 2685, 1928, 1513, 2048, 2048, 2048, 2048, 2048, 2048, 2048,
    2958, 1401, 1749, 2338, 1136, 2315, 1300, 1988, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2845, 2662, 1506, 2182, 1374,
    2183, 1149, 1950, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2924, 3554, 3393, 3652, 2955, 2109, 1575, 1532, 889, 1429,
    2048, 2048, 2048, 2048, 2048, 2747, 2220, 2802, 3026, 2348, 2170, 1824, 1282, 1030, 1638, 2048, 2048, 2048, 2048, 2048,
    2710, 1846, 1503, 2253, 1229, 1024, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048, 2048,
    // top_bit
    2048, 1812, 1294, 1217, 1515, 1271, 1502, 1154, 1349, 615, 1982, 2048, 2048, 2048, 2048, 2048, 2048,
    // second_bit
    2048, 2048, 1778, 1453, 1784, 1873, 1929, 1183, 2053, 883, 1982, 2048, 2048, 2048, 2048, 2048, 2048,
};

}  // namespace semblante::packed_tables
