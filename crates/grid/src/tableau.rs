//! Coefficients of the explicit Runge–Kutta pairs.

/// One pair: x_i = x + h Σ_l a_il k_l, x(t+h) = x + h Σ b_l k_l, with one or two estimates of the error, h Σ e_l k_l.
pub(crate) struct Tableau {
    pub(crate) c: &'static [f64],
    /// Row i contains a_il for l < i.
    pub(crate) a: &'static [&'static [f64]],
    pub(crate) b: &'static [f64],
    pub(crate) error: &'static [f64],
    /// Dormand and Prince's second estimate, of order 3; empty for a 5(4) pair.
    pub(crate) error3: &'static [f64],
    pub(crate) order: i32,
    /// Whether the last stage is the first of the next step.
    pub(crate) first_same_as_last: bool,
}

impl Tableau {
    pub(crate) fn stages(&self) -> usize {
        self.b.len()
    }
}

/// Order 5(4), 7 stages, 6 per step: J. R. Dormand and P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19. The pair of
/// ode45.
pub(crate) static DOPRI5: Tableau = Tableau {
    c: &[0.0, 0.2, 0.3, 0.8, 0.888_888_888_888_888_8, 1.0, 1.0],
    a: &[
        &[],
        &[0.2],
        &[0.075, 0.225],
        &[0.977_777_777_777_777_7, -3.733_333_333_333_333_4, 3.555_555_555_555_555_4],
        &[
            2.952_598_689_224_203_5,
            -11.595_793_324_188_385,
            9.822_892_851_699_436,
            -0.290_809_327_846_364_9,
        ],
        &[
            2.846_275_252_525_252_6,
            -10.757_575_757_575_758,
            8.906_422_717_743_473,
            0.278_409_090_909_090_9,
            -0.273_531_303_602_058_3,
        ],
        &[
            0.091_145_833_333_333_33,
            0.0,
            0.449_236_298_292_902_07,
            0.651_041_666_666_666_6,
            -0.322_376_179_245_283,
            0.130_952_380_952_380_96,
        ],
    ],
    b: &[
        0.091_145_833_333_333_33,
        0.0,
        0.449_236_298_292_902_07,
        0.651_041_666_666_666_6,
        -0.322_376_179_245_283,
        0.130_952_380_952_380_96,
        0.0,
    ],
    error: &[
        0.001_232_638_888_888_888_8,
        0.0,
        -0.004_252_770_290_506_139_4,
        0.036_979_166_666_666_67,
        -0.050_863_797_169_811_32,
        0.041_904_761_904_761_9,
        -0.025,
    ],
    error3: &[],
    order: 5,
    first_same_as_last: true,
};

/// Order 8(5,3), 12 stages: E. Hairer, S. P. Nørsett and G. Wanner, Solving Ordinary Differential Equations I, section
/// II.5.
pub(crate) static DOP853: Tableau = Tableau {
    c: &[
        0.0,
        0.052_600_151_958_767_73,
        0.078_900_227_938_151_6,
        0.118_350_341_907_227_4,
        0.281_649_658_092_772_6,
        0.333_333_333_333_333_3,
        0.25,
        0.307_692_307_692_307_7,
        0.651_282_051_282_051_3,
        0.6,
        0.857_142_857_142_857_1,
        1.0,
    ],
    a: &[
        &[],
        &[0.052_600_151_958_767_73],
        &[0.019_725_056_984_537_9, 0.059_175_170_953_613_7],
        &[0.029_587_585_476_806_85, 0.0, 0.088_762_756_430_420_54],
        &[0.241_365_134_159_266_7, 0.0, -0.884_549_479_328_286_1, 0.924_834_003_261_792],
        &[0.037_037_037_037_037_035, 0.0, 0.0, 0.170_828_608_729_473_86, 0.125_467_687_566_822_42],
        &[
            0.037_109_375,
            0.0,
            0.0,
            0.170_252_211_019_544_05,
            0.060_216_538_980_455_96,
            -0.017_578_125,
        ],
        &[
            0.037_092_000_118_504_79,
            0.0,
            0.0,
            0.170_383_925_712_239_98,
            0.107_262_030_446_373_28,
            -0.015_319_437_748_624_402,
            0.008_273_789_163_814_023,
        ],
        &[
            0.624_110_958_716_075_7,
            0.0,
            0.0,
            -3.360_892_629_446_941_4,
            -0.868_219_346_841_726,
            27.592_099_699_446_71,
            20.154_067_550_477_894,
            -43.489_884_181_069_96,
        ],
        &[
            0.477_662_536_438_264_34,
            0.0,
            0.0,
            -2.488_114_619_971_667_7,
            -0.590_290_826_836_843,
            21.230_051_448_181_193,
            15.279_233_632_882_423,
            -33.288_210_968_984_86,
            -0.020_331_201_708_508_627,
        ],
        &[
            -0.937_142_430_085_987_3,
            0.0,
            0.0,
            5.186_372_428_844_064,
            1.091_437_348_996_729_5,
            -8.149_787_010_746_927,
            -18.520_065_659_996_96,
            22.739_487_099_350_505,
            2.493_605_552_679_652_3,
            -3.046_764_471_898_219_6,
        ],
        &[
            2.273_310_147_516_538,
            0.0,
            0.0,
            -10.534_495_466_737_25,
            -2.000_872_058_224_862_5,
            -17.958_931_863_118_8,
            27.948_884_529_419_96,
            -2.858_998_277_135_023_5,
            -8.872_856_933_530_63,
            12.360_567_175_794_303,
            0.643_392_746_015_763_6,
        ],
    ],
    b: &[
        0.054_293_734_116_568_765,
        0.0,
        0.0,
        0.0,
        0.0,
        4.450_312_892_752_409,
        1.891_517_899_314_500_3,
        -5.801_203_960_010_585,
        0.311_164_366_957_819_9,
        -0.152_160_949_662_516_1,
        0.201_365_400_804_030_34,
        0.044_710_615_727_772_59,
    ],
    error: &[
        0.013_120_044_994_194_88,
        0.0,
        0.0,
        0.0,
        0.0,
        -1.225_156_446_376_204_4,
        -0.495_758_949_657_250_2,
        1.664_377_182_454_986_4,
        -0.350_328_848_749_973_66,
        0.334_179_118_713_017_5,
        0.081_923_206_485_115_71,
        -0.022_355_307_863_886_294,
    ],
    error3: &[
        -0.189_800_754_072_407_62,
        0.0,
        0.0,
        0.0,
        0.0,
        4.450_312_892_752_409,
        1.891_517_899_314_500_3,
        -5.801_203_960_010_585,
        -0.422_682_321_323_791_9,
        -0.152_160_949_662_516_1,
        0.201_365_400_804_030_34,
        0.022_651_792_198_360_82,
    ],
    order: 8,
    first_same_as_last: false,
};

#[cfg(test)]
mod tests {
    use super::*;
    use differential_equations::tableau::ButcherTableau;

    /// Σ b c^{k-1} = 1/k up to the order (quadrature conditions), row sums equal c, and error weights sum to 0.
    #[test]
    fn the_coefficients_meet_their_quadrature_conditions() {
        for tableau in [&DOPRI5, &DOP853] {
            for k in 1..=tableau.order {
                let sum: f64 =
                    tableau.b.iter().zip(tableau.c).map(|(b, c)| b * c.powi(k - 1)).sum();
                assert!((sum - 1.0 / f64::from(k)).abs() < 1e-14, "order {k}: {sum}");
            }
            for (row, c) in tableau.a.iter().zip(tableau.c) {
                assert!((row.iter().sum::<f64>() - c).abs() < 1e-14);
            }
            for weights in [&tableau.error, &tableau.error3] {
                assert!(weights.iter().sum::<f64>().abs() < 1e-14);
            }
            let last = tableau.a[tableau.stages() - 1];
            let same = last.iter().zip(tableau.b).all(|(a, b)| (a - b).abs() < 1e-16);
            assert_eq!(same, tableau.first_same_as_last);
        }
    }

    /// The coefficients of the crate differential-equations.
    #[test]
    fn the_coefficients_are_those_of_a_crate() {
        let of_crate = ButcherTableau::<f64, 7>::dopri5();
        let rows =
            |a: &[&[f64]], l: usize| a.iter().map(|row| row.get(l).copied()).collect::<Vec<_>>();
        same(&DOPRI5, &of_crate.c, &of_crate.b, &of_crate.er.unwrap());
        for l in 0..6 {
            let column: Vec<_> =
                of_crate.a.iter().enumerate().map(|(i, row)| (l < i).then_some(row[l])).collect();
            assert_eq!(rows(DOPRI5.a, l), column);
        }
        let of_crate = ButcherTableau::<f64, 12, 16>::dop853();
        same(&DOP853, &of_crate.c[..12], &of_crate.b, &of_crate.er.unwrap());
        for l in 0..11 {
            let own = of_crate.a[..12].iter().enumerate();
            assert_eq!(
                rows(DOP853.a, l),
                own.map(|(i, row)| (l < i).then_some(row[l])).collect::<Vec<_>>()
            );
        }
        let lower = of_crate.bh.unwrap();
        let second: Vec<f64> = of_crate.b.iter().zip(lower).map(|(b, l)| b - l).collect();
        assert_eq!(DOP853.error3, second);
    }

    fn same(tableau: &Tableau, c: &[f64], b: &[f64], error: &[f64]) {
        assert_eq!((tableau.c, tableau.b, tableau.error), (c, b, error));
    }
}
