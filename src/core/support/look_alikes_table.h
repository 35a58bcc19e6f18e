#pragma once

#include <array>
#include <string_view>

/// Characters that look like others, from the confusable characters of Unicode 15 (UTS #39,
/// "Unicode Security Mechanisms"): those that look like characters of ASCII, with or without
/// accents. Full-width forms and mathematical alphabets are left out, as they need no table.
namespace cbc::look_alikes {

struct Shape {
  char32_t shape;
  std::u32string_view characters;
};

/// Each character has the shape of one character of ASCII.
inline constexpr std::array<Shape, 80> shapes{{
    {U'!', U"ǃ\u2D51"},
    {U'&', U"\uA778"},
    {U'\'',
     U"\u00B4ʹʻʼʽʾˈˊˋ\u02F4\u0374\u0384\u055A\u055D\u05D9\u05F3\u07F4\u07F5ᑊᛌ\u1FBD\u1FBF"
     U"\u1FEF\u1FFD\u1FFE\u2018\u2019\u201B\u2032\u2035\uA78C\U00016F51\U00016F52"},
    {U'(', U"\u2768\u2772\u3014\uFD3E"},
    {U')', U"\u2769\u2773\u3015\uFD3F"},
    {U'*', U"\u066D\u204E\u2217\U0001031F"},
    {U'+', U"\u16ED\u2795\U0001029B"},
    {U',', U"\u00B8\u060D\u066B\u201A\uA4F9"},
    {U'-', U"\u02D7\u06D4\u2010\u2011\u2012\u2013\u2043\u2212\u2796\u2CBA\uFE58"},
    {U'.', U"\u0660\u06F0\u0701\u0702\u2024\uA4F8\uA60E\U00010A50\U0001D16D"},
    {U'/',
     U"\u1735\u2041\u2044\u2215\u2571\u27CB\u29F8\u2CC6\u2F03\u3033\u30CE\u31D3\u4E3F"
     U"\U0001D23A"},
    {U'2', U"ƧϨᒿ\uA644\uA6EF\uA75A\U0001FBF2"},
    {U'3', U"ƷȜЗӠ\u2CCC\uA76A\uA7AB\U000118CA\U00016F3B\U0001D206\U0001FBF3"},
    {U'4', U"Ꮞ\U000118AF\U0001FBF4"},
    {U'5', U"Ƽ\U000118BB\U0001FBF5"},
    {U'6', U"бᏮ\u2CD2\U000118D5\U0001FBF6"},
    {U'7', U"\U000104D2\U000118C6\U0001D212\U0001FBF7"},
    {U'8', U"Ȣȣ\u09EA\u0A6A\u0B03\U0001031A\U0001E8CB\U0001FBF8"},
    {U'9', U"\u09ED\u0A67\u0B68\u0D6D\u2CCA\uA76E\U000118AC\U000118CC\U000118D6\U0001FBF9"},
    {U':',
     U"ː\u02F8\u0589\u05C3\u0703\u0704\u0903\u0A83\u16EC\u1803\u1809\u205A\u2236\uA4FD"
     U"\uA789\uFE30"},
    {U';', U"\u037E"},
    {U'<', U"\u02C2ᐸᚲ\u2039\u276E\U0001D236"},
    {U'=', U"\u1400\u2E40\u30A0\uA4FF"},
    {U'>', U"\u02C3ᐳ\u203A\u276F\U00016F3F\U0001D237"},
    {U'?', U"ɁʔॽᎮ\uA6EB"},
    {U'A', U"ΑАᎪᗅ\uA4EE\U000102A0\U00016F40\U0001D6A8\U0001D6E2\U0001D71C\U0001D756\U0001D790"},
    {U'B',
     U"ΒВᏴᗷ\u212C\uA4D0\uA7B4\U00010282\U000102A1\U00010301\U0001D6A9\U0001D6E3\U0001D71D"
     U"\U0001D757\U0001D791"},
    {U'C',
     U"ϹСᏟ\u2102\u212D\u216D\u2CA4\uA4DA\U000102A2\U00010302\U00010415\U0001051C\U000118E9"
     U"\U000118F2\U0001F74C"},
    {U'D', U"Ꭰᗞᗪ\u2145\u216E\uA4D3"},
    {U'E',
     U"ΕЕᎬ\u2130\u22FF\u2D39\uA4F0\U00010286\U000118A6\U000118AE\U0001D6AC\U0001D6E6"
     U"\U0001D720\U0001D75A\U0001D794"},
    {U'F',
     U"Ϝᖴ\u2131\uA4DD\uA798\U00010287\U000102A5\U00010525\U000118A2\U000118C2\U0001D213"
     U"\U0001D7CA"},
    {U'G', U"ԌᏀᏳ\uA4D6"},
    {U'H',
     U"ΗНᎻᕼ\u210B\u210C\u210D\u2C8E\uA4E7\U000102CF\U0001D6AE\U0001D6E8\U0001D722"
     U"\U0001D75C\U0001D796"},
    {U'J', U"ͿЈᎫᒍ\uA4D9\uA7B2"},
    {U'K', U"ΚКᏦᛕ\u212A\u2C94\uA4D7\U00010518\U0001D6B1\U0001D6EB\U0001D725\U0001D75F\U0001D799"},
    {U'L',
     U"Ꮮᒪ\u2112\u216C\u2CD0\uA4E1\U0001041B\U00010526\U000118A3\U000118B2\U00016F16"
     U"\U0001D22A"},
    {U'M',
     U"ΜϺМᎷᗰᛖ\u2133\u216F\u2C98\uA4DF\U000102B0\U00010311\U0001D6B3\U0001D6ED\U0001D727"
     U"\U0001D761\U0001D79B"},
    {U'N', U"Ν\u2115\u2C9A\uA4E0\U00010513\U0001D6B4\U0001D6EE\U0001D728\U0001D762\U0001D79C"},
    {U'O',
     U"0ΟОՕ\u07C0\u09E6ଠ\u0B66ዐ\u2C9E\u2D54\u3007\uA4F3\U00010292\U000102AB\U00010404"
     U"\U000104C2\U00010516\U000114D0\U000118B5\U000118E0\U0001D6B6\U0001D6F0\U0001D72A"
     U"\U0001D764\U0001D79E\U0001FBF0"},
    {U'P', U"ΡРᏢᑭ\u2119\u2CA2\uA4D1\U00010295\U0001D6B8\U0001D6F2\U0001D72C\U0001D766\U0001D7A0"},
    {U'Q', U"\u211A\u2D55"},
    {U'R', U"ƦᎡᏒᖇ\u211B\u211C\u211D\uA4E3\U000104B4\U00016F35\U0001D216"},
    {U'S', U"ЅՏᏕᏚ\uA4E2\U00010296\U00010420\U00016F3A"},
    {U'T',
     U"ΤТᎢ\u22A4\u27D9\u2CA6\uA4D4\U00010297\U000102B1\U00010315\U000118BC\U00016F0A"
     U"\U0001D6BB\U0001D6F5\U0001D72F\U0001D769\U0001D7A3\U0001F768"},
    {U'U', U"Սሀᑌ\u222A\u22C3\uA4F4\U000104CE\U000118B8\U00016F42"},
    {U'V', U"Ѵ\u0667\u06F7Ꮩᐯ\u2164\u2D38\uA4E6\uA6DF\U0001051D\U000118A0\U00016F08\U0001D20D"},
    {U'W', U"ԜᎳᏔ\uA4EA\U000118E6\U000118EF"},
    {U'X',
     U"ΧХ\u166Dᚷ\u2169\u2573\u2CAC\u2D5D\uA4EB\uA7B3\U00010290\U000102B4\U00010317"
     U"\U00010322\U00010527\U000118EC\U0001D6BE\U0001D6F8\U0001D732\U0001D76C\U0001D7A6"},
    {U'Y',
     U"ΥϒУҮᎩᎽ\u2CA8\uA4EC\U000102B2\U000118A4\U00016F43\U0001D6BC\U0001D6F6\U0001D730"
     U"\U0001D76A\U0001D7A4"},
    {U'Z',
     U"ΖᏃ\u2124\u2128\uA4DC\U000102F5\U000118A9\U000118E5\U0001D6AD\U0001D6E7\U0001D721"
     U"\U0001D75B\U0001D795"},
    {U'\\', U"\u2216\u27CD\u29F5\u29F9\u2F02\u31D4\u4E36\uFE68\U0001D20F\U0001D23B"},
    {U'^', U"\u02C4ˆ"},
    {U'_', U"\u07FA\uFE4D\uFE4E\uFE4F"},
    {U'a', U"ɑαа\u237A\U0001D6C2\U0001D6FC\U0001D736\U0001D770\U0001D7AA"},
    {U'b', U"ƄЬᏏᑲᖯ"},
    {U'c', U"ϲс\u1D04\u217D\u2CA5\uABAF\U0001043D"},
    {U'd', U"ԁᏧᑯ\u2146\u217E\uA4D2"},
    {U'e', U"еҽ\u212E\u212F\u2147\uAB32"},
    {U'f', U"ſք\u1E9D\uA799\uAB35"},
    {U'g', U"ƍɡց\u1D83\u210A"},
    {U'h', U"һհᏂ\u210E"},
    {U'i',
     U"ıɩɪ\u02DBͺιіӏᎥ\u1FBE\u2139\u2148\u2170\u2373\uA647\uAB75\U000118C3\U0001D6A4"
     U"\U0001D6CA\U0001D704\U0001D73E\U0001D778\U0001D7B2"},
    {U'j', U"ϳј\u2149"},
    {U'l',
     U"1I|ƖǀΙІӀ\u05C0\u05D5\u05DF\u0627\u0661\u06F1\u07CAᛁ\u2110\u2111\u2113\u2160\u217C"
     U"\u2223\u23FD\u2C92\u2D4F\uA4F2\uFE8D\uFE8E\uFFE8\U0001028A\U00010309\U00010320"
     U"\U00016F28\U0001D6B0\U0001D6EA\U0001D724\U0001D75E\U0001D798\U0001E8C7\U0001EE00"
     U"\U0001EE80\U0001FBF1"},
    {U'm', U"\u217F\U00011700\U000118E3"},
    {U'n', U"ոռ"},
    {U'o',
     U"οσоօ\u05E1\u0647\u0665\u06BE\u06C1\u06D5\u06F5\u0966\u0A66\u0AE6\u0BE6\u0C02\u0C66"
     U"\u0C82\u0CE6\u0D02ഠ\u0D66\u0D82\u0E50\u0ED0ဝ\u1040ჿ\u1D0F\u1D11\u2134\u2C9F\uAB3D"
     U"\uFBA6\uFBA7\uFBA8\uFBA9\uFBAA\uFBAB\uFBAC\uFBAD\uFEE9\uFEEA\uFEEB\uFEEC\U0001042C"
     U"\U000104EA\U000118C8\U000118D7\U0001D6D0\U0001D6D4\U0001D70A\U0001D70E\U0001D744"
     U"\U0001D748\U0001D77E\U0001D782\U0001D7B8\U0001D7BC\U0001EE24\U0001EE64\U0001EE84"},
    {U'p',
     U"ρϱр\u2374\u2CA3\U0001D6D2\U0001D6E0\U0001D70C\U0001D71A\U0001D746\U0001D754"
     U"\U0001D780\U0001D78E\U0001D7BA\U0001D7C8"},
    {U'q', U"ԛգզ"},
    {U'r', U"г\u1D26\u2C85\uAB47\uAB48\uAB81"},
    {U's', U"ƽѕ\uA731\uABAA\U00010448\U000118C1"},
    {U'u',
     U"ʋυս\u1D1C\uA79F\uAB4E\uAB52\U000104F6\U000118D8\U0001D6D6\U0001D710\U0001D74A"
     U"\U0001D784\U0001D7BE"},
    {U'v',
     U"νѵ\u05D8\u1D20\u2174\u2228\u22C1\uABA9\U00011706\U000118C0\U0001D6CE\U0001D708"
     U"\U0001D742\U0001D77C\U0001D7B6"},
    {U'w', U"ɯѡԝա\u1D21\uAB83\U0001170A\U0001170E\U0001170F"},
    {U'x', U"\u00D7хᕁᕽ\u166E\u2179\u292B\u292C\u2A2F"},
    {U'y',
     U"ɣʏγуүყ\u1D8C\u1EFF\u213D\uAB5A\U000118DC\U0001D6C4\U0001D6FE\U0001D738\U0001D772"
     U"\U0001D7AC"},
    {U'z', U"\u1D22\uAB93\U000118C4"},
    {U'{', U"\u2774\U0001D114"},
    {U'}', U"\u2775"},
    {U'~', U"\u02DC\u1FC0\u2053\u223C"},
}};

struct Ligature {
  char32_t character;
  std::string_view letters;
};

/// Each character looks like several letters.
inline constexpr std::array<Ligature, 82> ligatures{
    {{U'Æ', "AE"},          {U'æ', "ae"},          {U'Ĳ', "lJ"},          {U'ĳ', "ij"},
     {U'Œ', "OE"},          {U'œ', "oe"},          {U'ǁ', "ll"},          {U'Ǉ', "LJ"},
     {U'ǈ', "Lj"},          {U'ǉ', "lj"},          {U'Ǌ', "NJ"},          {U'ǋ', "Nj"},
     {U'ǌ', "nj"},          {U'Ǳ', "DZ"},          {U'ǲ', "Dz"},          {U'ǳ', "dz"},
     {U'ʣ', "dz"},          {U'ʦ', "ts"},          {U'ʪ', "ls"},          {U'ʫ', "lz"},
     {U'Ы', "bl"},          {U'Ю', "lO"},          {U'Ӕ', "AE"},          {U'ӕ', "ae"},
     {U'\u05F0', "ll"},     {U'\u1D6B', "ue"},     {U'\u2016', "ll"},     {U'\u20A8', "Rs"},
     {U'\u20B6', "lt"},     {U'\u2116', "No"},     {U'\u2121', "TEL"},    {U'\u213B', "FAX"},
     {U'\u2161', "ll"},     {U'\u2162', "lll"},    {U'\u2163', "lV"},     {U'\u2165', "Vl"},
     {U'\u2166', "Vll"},    {U'\u2167', "Vlll"},   {U'\u2168', "lX"},     {U'\u216A', "Xl"},
     {U'\u216B', "Xll"},    {U'\u2171', "ii"},     {U'\u2172', "iii"},    {U'\u2173', "iv"},
     {U'\u2175', "vi"},     {U'\u2176', "vii"},    {U'\u2177', "viii"},   {U'\u2178', "ix"},
     {U'\u217A', "xi"},     {U'\u217B', "xii"},    {U'\u221E', "oo"},     {U'\u2225', "ll"},
     {U'\uA698', "OO"},     {U'\uA699', "oo"},     {U'\uA728', "T3"},     {U'\uA732', "AA"},
     {U'\uA733', "aa"},     {U'\uA734', "AO"},     {U'\uA735', "ao"},     {U'\uA736', "AU"},
     {U'\uA737', "au"},     {U'\uA738', "AV"},     {U'\uA739', "av"},     {U'\uA73A', "AV"},
     {U'\uA73B', "av"},     {U'\uA73C', "AY"},     {U'\uA73D', "ay"},     {U'\uA74E', "OO"},
     {U'\uA74F', "oo"},     {U'\uA777', "tf"},     {U'\uAB63', "uo"},     {U'\uFB00', "ff"},
     {U'\uFB01', "fi"},     {U'\uFB02', "fl"},     {U'\uFB03', "ffi"},    {U'\uFB04', "ffl"},
     {U'\uFB06', "st"},     {U'\U0001F700', "QE"}, {U'\U0001F707', "AR"}, {U'\U0001F75C', "sss"},
     {U'\U0001F76B', "MB"}, {U'\U0001F76C', "VB"}}};

struct Accent {
  std::u32string_view marks;
  std::u32string_view letters;
  std::u32string_view composed;  ///< in the order of the letters
};

/// Letters with accents, and with strokes through them.
inline constexpr std::array<Accent, 84> accents{{
    {U"\u0300", U"AElOUaeiouNnEeWwYyaiouAEHlYO",
     U"ÀÈÌÒÙàèìòùǸǹЀѐ\u1E80\u1E81\u1EF2\u1EF3\u1F70\u1F76\u1F78\u1F7A\u1FBA\u1FC8\u1FCA\u1FDA"
     U"\u1FEA\u1FF8"},
    {U"\u0301", U"AElOUYaeiouyCcLlNnRrSsZzGgAEHlOYaiouYKrKkMPpWwaiouAEHlYO",
     U"ÁÉÍÓÚÝáéíóúýĆćĹĺŃńŔŕŚśŹźǴǵΆΈΉΊΌΎάίόύϓЌѓ\u1E30\u1E31\u1E3E\u1E54\u1E55\u1E82\u1E83\u1F71"
     U"\u1F77\u1F79\u1F7B\u1FBB\u1FC9\u1FCB\u1FDB\u1FEB\u1FF9"},
    {U"\u0301\u0307", U"Ss", U"\u1E64\u1E65"},
    {U"\u0302", U"AElOUaeiouCcGgHhJjSsWwYyAaEeliOoRrUuoZz",
     U"ÂÊÎÔÛâêîôûĈĉĜĝĤĥĴĵŜŝŴŵŶŷȂȃȆȇȊȋȎȏȒȓȖȗ\u06FF\u1E90\u1E91"},
    {U"\u0302\u0300", U"AaEeOo", U"\u1EA6\u1EA7\u1EC0\u1EC1\u1ED2\u1ED3"},
    {U"\u0302\u0301", U"AaEeOo", U"\u1EA4\u1EA5\u1EBE\u1EBF\u1ED0\u1ED1"},
    {U"\u0302\u0303", U"AaEeOo", U"\u1EAA\u1EAB\u1EC4\u1EC5\u1ED6\u1ED7"},
    {U"\u0302\u0309", U"AaEeOo", U"\u1EA8\u1EA9\u1EC2\u1EC3\u1ED4\u1ED5"},
    {U"\u0303", U"ANOanoliUulVvEeYyaiu",
     U"ÃÑÕãñõĨĩŨũ\u0622\u1E7C\u1E7D\u1EBC\u1EBD\u1EF8\u1EF9\u1FB6\u1FD6\u1FE6"},
    {U"\u0303\u0301", U"OoUu", U"\u1E4C\u1E4D\u1E78\u1E79"},
    {U"\u0303\u0304", U"Oo", U"Ȭȭ"},
    {U"\u0303\u0308", U"Oo", U"\u1E4E\u1E4F"},
    {U"\u0304", U"AaEeliOoUubbdYybYyGgaAiluY",
     U"ĀāĒēĪīŌōŪūƂƃƌȲȳБӮӯ\u1E20\u1E21\u1FB1\u1FB9\u1FD1\u1FD9\u1FE1\u1FE9"},
    {U"\u0304\u0300", U"EeOo", U"\u1E14\u1E15\u1E50\u1E51"},
    {U"\u0304\u0301", U"EeOo", U"\u1E16\u1E17\u1E52\u1E53"},
    {U"\u0304\u0308", U"Uu", U"\u1E7A\u1E7B"},
    {U"\u0306", U"AaCcDdEeEeGgliLlNnOoRrSsTtUuZzAaliOoUuGgKkjHhYyAaEeaAiluY",
     U"ĂăČčĎďĔĕĚěĞğĬĭĽľŇňŎŏŘřŠšŤťŬŭŽžǍǎǏǐǑǒǓǔǦǧǨǩǰȞȟЎўӐӑӖӗ\u1FB0\u1FB8\u1FD0\u1FD8\u1FE0\u1FE8"},
    {U"\u0306\u0300", U"Aa", U"\u1EB0\u1EB1"},
    {U"\u0306\u0301", U"Aa", U"\u1EAE\u1EAF"},
    {U"\u0306\u0303", U"Aa", U"\u1EB4\u1EB5"},
    {U"\u0306\u0307", U"Ss", U"\u1E66\u1E67"},
    {U"\u0306\u0309", U"Aa", U"\u1EB2\u1EB3"},
    {U"\u0307", U"CcEeGglZzAaOobBbDdFfHhMNnPpRrSsTtWwXxYyfxlw",
     U"ĊċĖėĠġİŻżȦȧȮȯᑳ\u1E02\u1E03\u1E0A\u1E0B\u1E1E\u1E1F\u1E22\u1E23\u1E40\u1E44\u1E45\u1E56"
     U"\u1E57\u1E58\u1E59\u1E60\u1E61\u1E6A\u1E6B\u1E86\u1E87\u1E8A\u1E8B\u1E8E\u1E8F\u1E9B"
     U"\u2A30\uFB4B\U000114C5"},
    {U"\u0307\u0304", U"AaOo", U"ǠǡȰȱ"},
    {U"\u0308", U"AElOUaeiouyYlYiuYEleiAaOoYyHhWwXxtT",
     U"ÄËÏÖÜäëïöüÿŸΪΫϊϋϔЁЇёїӒӓӦӧӰӱ\u1E26\u1E27\u1E84\u1E85\u1E8C\u1E8D\u1E97\u2361"},
    {U"\u0308\u0300", U"Uuiu", U"Ǜǜ\u1FD2\u1FE2"},
    {U"\u0308\u0301", U"Uuiuliiu", U"Ǘǘΐΰ\u1E2E\u1E2F\u1FD3\u1FE3"},
    {U"\u0308\u0303", U"iu", U"\u1FD7\u1FE7"},
    {U"\u0308\u0304", U"UuAaOo", U"ǕǖǞǟȪȫ"},
    {U"\u0308\u0306", U"Uu", U"Ǚǚ"},
    {U"\u0309", U"aAaEeliOoUuYy",
     U"\u1E9A\u1EA2\u1EA3\u1EBA\u1EBB\u1EC8\u1EC9\u1ECE\u1ECF\u1EE6\u1EE7\u1EF6\u1EF7"},
    {U"\u030A", U"AaUuwyAN", U"ÅåŮů\u1E98\u1E99\u212B\U0001018E"},
    {U"\u030A\u0301", U"Aa", U"Ǻǻ"},
    {U"\u030B", U"OoUuYyll", U"ŐőŰűӲӳ\uFD3C\uFD3D"},
    {U"\u030F", U"AaEeliOoRrUuVv", U"ȀȁȄȅȈȉȌȍȐȑȔȕѶѷ"},
    {U"\u0313", U"aAEHiloOup", U"\u1F00\u1F08\u1F18\u1F28\u1F30\u1F38\u1F40\u1F48\u1F50\u1FE4"},
    {U"\u0313\u0300", U"aAEHiloOu", U"\u1F02\u1F0A\u1F1A\u1F2A\u1F32\u1F3A\u1F42\u1F4A\u1F52"},
    {U"\u0313\u0301", U"aAEHiloOu", U"\u1F04\u1F0C\u1F1C\u1F2C\u1F34\u1F3C\u1F44\u1F4C\u1F54"},
    {U"\u0313\u0303", U"aAHilu", U"\u1F06\u1F0E\u1F2E\u1F36\u1F3E\u1F56"},
    {U"\u0314", U"kptybdghqhaAEHiloOuYpPh",
     U"ƙƥƭƴɓɗɠɦʠᏲ\u1F01\u1F09\u1F19\u1F29\u1F31\u1F39\u1F41\u1F49\u1F51\u1F59\u1FE5\u1FEC\uA695"},
    {U"\u0314\u0300", U"aAEHiloOuY",
     U"\u1F03\u1F0B\u1F1B\u1F2B\u1F33\u1F3B\u1F43\u1F4B\u1F53\u1F5B"},
    {U"\u0314\u0301", U"aAEHiloOuY",
     U"\u1F05\u1F0D\u1F1D\u1F2D\u1F35\u1F3D\u1F45\u1F4D\u1F55\u1F5D"},
    {U"\u0314\u0303", U"aAHiluY", U"\u1F07\u1F0F\u1F2F\u1F37\u1F3F\u1F57\u1F5F"},
    {U"\u031B", U"OoUuo", U"ƠơƯư\uAB74"},
    {U"\u031B\u0300", U"OoUu", U"\u1EDC\u1EDD\u1EEA\u1EEB"},
    {U"\u031B\u0301", U"OoUu", U"\u1EDA\u1EDB\u1EE8\u1EE9"},
    {U"\u031B\u0303", U"OoUu", U"\u1EE0\u1EE1\u1EEE\u1EEF"},
    {U"\u031B\u0309", U"OoUu", U"\u1EDE\u1EDF\u1EEC\u1EED"},
    {U"\u031B\u0323", U"OoUu", U"\u1EE2\u1EE3\u1EF0\u1EF1"},
    {U"\u0323", U"BbDdHhKkLlMNnRrSsTtVvWwZzAaEeliOoUuYy",
     U"\u1E04\u1E05\u1E0C\u1E0D\u1E24\u1E25\u1E32\u1E33\u1E36\u1E37\u1E42\u1E46\u1E47\u1E5A"
     U"\u1E5B\u1E62\u1E63\u1E6C\u1E6D\u1E7E\u1E7F\u1E88\u1E89\u1E92\u1E93\u1EA0\u1EA1\u1EB8"
     U"\u1EB9\u1ECA\u1ECB\u1ECC\u1ECD\u1EE4\u1EE5\u1EF4\u1EF5"},
    {U"\u0323\u0302", U"AaEeOo", U"\u1EAC\u1EAD\u1EC6\u1EC7\u1ED8\u1ED9"},
    {U"\u0323\u0304", U"LlRr", U"\u1E38\u1E39\u1E5C\u1E5D"},
    {U"\u0323\u0306", U"Aa", U"\u1EB6\u1EB7"},
    {U"\u0323\u0307", U"Ss", U"\u1E68\u1E69"},
    {U"\u0324", U"Uu", U"\u1E72\u1E73"},
    {U"\u0325", U"Aa", U"\u1E00\u1E01"},
    {U"\u0326", U"CcGgKkLlNnRrSsTtFfNSsTtZzEeCcHHMDdHhw",
     U"ÇçĢģĶķĻļŅņŖŗŞşŢţƑƒƝȘșȚțȤȥȨȩҪҫӇӉӍ\u1E10\u1E11\u1E28\u1E29\uA761"},
    {U"\u0326\u0301", U"Cc", U"\u1E08\u1E09"},
    {U"\u0326\u0306", U"Ee", U"\u1E1C\u1E1D"},
    {U"\u0328", U"AaEeliUuTOodlnrszeaAH", U"ĄąĘęĮįŲųƮǪǫɖɭɳɽʂʐҿ\u1FB3\u1FBC\u1FCC"},
    {U"\u0328\u0300", U"a", U"\u1FB2"},
    {U"\u0328\u0301", U"a", U"\u1FB4"},
    {U"\u0328\u0303", U"a", U"\u1FB7"},
    {U"\u0328\u0304", U"Oo", U"Ǭǭ"},
    {U"\u0328\u0313", U"aAH", U"\u1F80\u1F88\u1F98"},
    {U"\u0328\u0314", U"aAH", U"\u1F81\u1F89\u1F99"},
    {U"\u0328\u0329", U"n", U"\u1FC3"},
    {U"\u0329", U"nrnKHTXHKnnnnn",
     U"ƞɼηҚҢҬҲ\u2C67\u2C69\U0001D6C8\U0001D702\U0001D73C\U0001D776\U0001D7B0"},
    {U"\u0329\u0300", U"n", U"\u1F74"},
    {U"\u0329\u0301", U"nn", U"ή\u1F75"},
    {U"\u0329\u0303", U"n", U"\u1FC6"},
    {U"\u0329\u0313", U"n", U"\u1F20"},
    {U"\u0329\u0314", U"n", U"\u1F21"},
    {U"\u032D", U"DdEeLlNnTtUu",
     U"\u1E12\u1E13\u1E18\u1E19\u1E3C\u1E3D\u1E4A\u1E4B\u1E70\u1E71\u1E76\u1E77"},
    {U"\u032E", U"Hh", U"\u1E2A\u1E2B"},
    {U"\u0330", U"EeliUu", U"\u1E1A\u1E1B\u1E2C\u1E2D\u1E74\u1E75"},
    {U"\u0331", U"BbDdKkLlNnRrTtZzh",
     U"\u1E06\u1E07\u1E0E\u1E0F\u1E34\u1E35\u1E3A\u1E3B\u1E48\u1E49\u1E5E\u1E5F\u1E6E\u1E6F"
     U"\u1E94\u1E95\u1E96"},
    {U"\u0332", U"ai", U"\u2376\u2378"},
    {U"\u0334", U"lfnrstz", U"ɫ\u1D6E\u1D70\u1D72\u1D74\u1D75\u1D76"},
    {U"\u0335",
     U"YDDdHhTtbDllOZzGgUJjrYyioOOOOhbbOobbrKYyOoOUOiipuWKhOOOOKOoouoXVOOOOOOOOOOOOOOOOOOOOOO",
     U"\u00A5ÐĐđĦħŦŧƀƉƗƚƟƵƶǤǥɄɈɉɍɎɏɨɵΘθϑϴћѢѣѲѳҌҍғҞҰұӨөᎾᏌᏫ\u1D7B\u1D7C\u1D7D\u1D7E\u20A9\u20AD"
     U"\u210F\u2296\u229D\u236C\u2D31\uA740\uA74A\uA74B\uAB8E\uAB9C\uABBB\U00010196\U00010197"
     U"\U0001D21A\U0001D6AF\U0001D6B9\U0001D6C9\U0001D6DD\U0001D6E9\U0001D6F3\U0001D703"
     U"\U0001D717\U0001D723\U0001D72D\U0001D73D\U0001D751\U0001D75D\U0001D767\U0001D777"
     U"\U0001D78B\U0001D797\U0001D7A1\U0001D7B1\U0001D7C5\U0001F714"},
    {U"\u0335\u0308", U"Oo", U"Ӫӫ"},
    {U"\u0335\u0331", U"d", U"\u20AB"},
    {U"\u0338", U"cOoLlcTEelOo", U"\u00A2ØøŁłȼȾɆɇ\u2224\u2D41\uAB3E"},
    {U"\u0338\u0301", U"Oo", U"Ǿǿ"},
}};

struct Marks {
  std::u32string_view marks;
  std::u32string_view characters;
};

/// Combining marks that look like others.
inline constexpr std::array<Marks, 18> marks{{
    {U"\u0300", U"\u0340"},
    {U"\u0301", U"\u0341"},
    {U"\u0302", U"\u0311"},
    {U"\u0303", U"\u0342"},
    {U"\u0304", U"\u0305"},
    {U"\u0306", U"\u030C\u036E"},
    {U"\u0306\u0307", U"\u0310"},
    {U"\u0307", U"\u0358"},
    {U"\u0308\u0301", U"\u0344"},
    {U"\u030A", U"\u0366"},
    {U"\u0313", U"\u0315\u0343"},
    {U"\u0326", U"\u0321\u0327\u0339"},
    {U"\u0328", U"\u0322\u0345"},
    {U"\u0331", U"\u0320"},
    {U"\u0333", U"\u0347"},
    {U"\u0335", U"\u0336"},
    {U"\u0338", U"\u0337"},
    {U"\u0350", U"\u0357"},
}};

}  // namespace cbc::look_alikes
