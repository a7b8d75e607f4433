//! `stickslip continue`.

mod document;

use super::asking::context;
use super::cycle::start::question;
use super::in_units::scales;
use super::job::{Job, judge_places};
use super::model::{refuse_endless, refused_wider, tip, wider};
use super::progress::Progress;
use super::told::digits;
use crate::arguments::ContinueArguments;
use crate::failure::{Failure, Typed};
use crate::interrupt::Interrupt;
use std::ops::ControlFlow;
use stickslip::{self as documents, Ask, ContinueDocument, Cycle as Question, OverName, Physical};
use stickslip_cycles::{Branch, Continuation, Cycle, CycleError, Parameter, Special, SpecialKind};
use stickslip_tip::{Model, TipFunction, Wider, stop};

/// Branches of twice the period, of four times and so on: a cascade has no end.
const MOST_BRANCHES: usize = 12;
/// Period doublings nearer to each other than this, relatively, are one.
const SAME: f64 = 1e-6;

pub(crate) fn follow(arguments: &ContinueArguments) -> Result<(), Failure> {
    let start = &arguments.start;
    let read =
        [("--tip-file", start.model.tip.tip_file.as_deref()), ("--from", start.from.as_deref())];
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &read)?;
    let settings = settings(arguments)?;
    let origin = Origin::asked(arguments)?;
    let tip_file = start.model.tip.tip_file.as_deref();
    let r = (arguments.over == OverName::Alpha).then(|| origin.r());
    let scales = scales(&arguments.in_units, tip_file, r)?;
    let job = Job::open::<ContinueDocument>(&arguments.outlet, arguments.plot.as_deref())?;

    let interrupt = Interrupt::listen()?;
    let found = stop::where_asked_by(interrupt.flag(), || {
        branches(arguments, &settings, &origin, &interrupt)
    });
    let signal = interrupt.signal();
    let (branches, remarks) = match (found, signal) {
        (Err(_), Some(signal)) => return Err(Failure::Stopped(signal)),
        (found, _) => found?,
    };
    let document = document::of(arguments, &origin, &branches, (remarks, signal.is_some()));
    // What is complete can be computed again: from here on a first signal ends the program at once.
    let _keeps = signal.map(|_| interrupt);
    job.finish(document.in_units(scales.as_ref()))?;
    signal.map_or(Ok(()), |signal| Err(Failure::Interrupted(signal)))
}

/// What the first branch begins with.
enum Origin {
    Cycle(Box<Question>, Model),
    /// Onset at this value of what does not vary.
    Onset {
        law: Wider,
        tip: TipFunction,
        other: f64,
    },
}

impl Origin {
    fn asked(arguments: &ContinueArguments) -> Result<Self, Failure> {
        let asked = &arguments.start.model;
        let alpha = asked.alpha.is_some() || asked.alpha_above.is_some();
        let (varies, other) = match arguments.over {
            OverName::Alpha => (alpha, asked.r),
            OverName::R => (asked.r.is_some(), asked.alpha),
        };
        if varies || arguments.start.from.is_some() {
            let question = question(&arguments.start)?.resolved(&context())?;
            let model = question.model()?;
            return Ok(Self::Cycle(Box::new(question), model));
        }
        Question::judge_tolerance(arguments.start.tolerance)?;
        let missing = match arguments.over {
            OverName::Alpha => Failure::input("--r", "missing: give --r R, at which α is to vary"),
            OverName::R => {
                Failure::input("--alpha", "missing: give --alpha A, at which r is to vary")
            }
        };
        refuse_endless(&asked.tip, &asked.wider)?;
        let (law, tip) = (wider(&asked.wider), tip(&asked.tip)?);
        law.validate().map_err(|error| refused_wider(&error))?;
        Ok(Self::Onset { law, tip, other: other.ok_or(missing)? })
    }

    /// Where α varies.
    fn r(&self) -> f64 {
        match self {
            Self::Cycle(_, model) => model.r(),
            Self::Onset { other, .. } => *other,
        }
    }

    fn wider(&self) -> &Wider {
        match self {
            Self::Cycle(_, model) => model.wider(),
            Self::Onset { law, .. } => law,
        }
    }

    fn tip(&self) -> &TipFunction {
        match self {
            Self::Cycle(_, model) => model.tip(),
            Self::Onset { tip, .. } => tip,
        }
    }
}

fn settings(arguments: &ContinueArguments) -> Result<Continuation, Failure> {
    let positive = |option: &str, value: f64| {
        if value.is_finite() && value > 0.0 {
            return Ok(value);
        }
        Err(Failure::input(format!("{option} {}", Typed(value)), "must be a finite number above 0"))
    };
    let over = arguments.over.into();
    let nowhere = match over {
        Parameter::Alpha => f64::INFINITY,
        Parameter::R => 0.0,
    };
    if arguments.most_points == 0 {
        return Err(Failure::input("--most-points 0", "1 or more will do"));
    }
    Ok(Continuation {
        over,
        to: arguments.to.map_or(Ok(nowhere), |to| positive("--to", to))?,
        tolerance: arguments.start.tolerance,
        longest_period: positive("--longest-period", arguments.longest_period)?,
        longest_step: positive("--longest-step", arguments.longest_step)?,
        most_points: arguments.most_points,
    })
}

/// A branch, and the special point of another (branch, place in its list) that it began at.
struct Found {
    branch: Branch,
    from: Option<(usize, usize)>,
}

fn branches(
    arguments: &ContinueArguments,
    settings: &Continuation,
    origin: &Origin,
    interrupt: &Interrupt,
) -> Result<(Vec<Found>, Vec<String>), Failure> {
    let mut remarks = vec![];
    // How far a branch goes, and whether it turns back, nobody knows before.
    let mut progress = Progress::without_end().at_every_call();
    let name = if settings.over == Parameter::Alpha { "α" } else { "r" };
    let mut cycles = 0;
    let mut observe = |cycle: &Cycle| {
        let at = parameter(cycle, settings.over);
        cycles += 1;
        progress.counted(0.0, || format!("{cycles} cycles, {name} = {}", digits(at, 6)));
        if interrupt.signal().is_some() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let first = match origin {
        Origin::Cycle(question, _) => settings.from_cycle(&question.solve()?, &mut observe),
        Origin::Onset { law, tip, other } => {
            settings.from_onset_under((law, tip), *other, &mut observe)
        }
    };
    let first = first.map_err(|error| explain_onset(&error, arguments))?;
    let mut found = vec![Found { branch: first, from: None }];
    let mut next = 0;
    while arguments.switch && next < found.len() && interrupt.signal().is_none() {
        for i in 0..found[next].branch.special.len() {
            let special = &found[next].branch.special[i];
            let known = special.kind != SpecialKind::PeriodDoubling || is_end_of(special, &found);
            if known || found.len() >= MOST_BRANCHES {
                continue;
            }
            match settings.switched(special, &mut observe) {
                Ok(branch) => found.push(Found { branch, from: Some((next, i)) }),
                Err(error) => remarks.push(format!("a branch of twice the period: {error}")),
            }
        }
        next += 1;
    }
    Ok((found, remarks))
}

/// Whether a branch that was followed already has come back there.
fn is_end_of(doubling: &Special, found: &[Found]) -> bool {
    let special = found.iter().flat_map(|f| &f.branch.special);
    special.filter(|s| s.kind == SpecialKind::PeriodHalving).any(|s| {
        let near = |a: f64, b: f64| (a - b).abs() <= SAME * b;
        near(s.alpha, doubling.alpha) && near(s.r, doubling.r) && near(s.period, doubling.period)
    })
}

fn parameter(cycle: &Cycle, over: Parameter) -> f64 {
    match over {
        Parameter::Alpha => cycle.model().alpha(),
        Parameter::R => cycle.model().r(),
    }
}

fn explain_onset(error: &CycleError, arguments: &ContinueArguments) -> Failure {
    match (error, arguments.over) {
        (CycleError::Stability(error), OverName::Alpha) => {
            let r = arguments.start.model.r.unwrap_or_default();
            Failure::input(format!("--r {}", Typed(r)), error)
        }
        (CycleError::Stability(error), OverName::R) => {
            let alpha = arguments.start.model.alpha.unwrap_or_default();
            Failure::input(format!("--alpha {}", Typed(alpha)), error)
        }
        // There is no nearer one that it could start from.
        (CycleError::NotConverged { alpha, r }, over) if arguments.start.from.is_none() => {
            let further = match over {
                OverName::Alpha => format!("--alpha {}", digits(1.05 * alpha, 4)),
                OverName::R => format!("--r {}", digits(0.95 * r, 4)),
            };
            Failure::Run(format!(
                "no cycle was reached where the branch begins, at alpha = {alpha:?}, r = {r:?}: begin further on, with \
                 {further}, or with --from and a document of `stickslip cycle`"
            ))
        }
        _ => documents::Failure::from(error.clone()).into(),
    }
}
