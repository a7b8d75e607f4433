//! Linear stability of steady motion (section IV of the paper).
