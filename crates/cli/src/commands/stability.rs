//! `stickslip stability`.

mod raster;
mod walking;
mod wider;

use super::job::{Job, judge_places};
use super::model::{refuse_endless, tip, wide_model, wider as wider_law};
use super::roots::{complex, failed, judge_count, leftmost, remarks};
use crate::arguments::{ModelArguments, StabilityArguments};
use crate::commands::in_units::scales;
use crate::failure::{Failure, Typed};
use stickslip::{
    CriticalDocument, Document, ModelParameters, OnsetDocument, Physical, SolveFor,
    StabilityDocument, StabilityFound, StabilityParameters, TrappingDocument,
};
use stickslip_stability::{
    Critical, OnsetKind, Spectrum, StabilityError, critical, critical_r, leading_roots, roots,
    unstable_count,
};
use stickslip_tip::{Model, TipFunction, Wider};

const DEFAULT_ROOTS: usize = 10;

pub(crate) fn stability(arguments: &StabilityArguments) -> Result<(), Failure> {
    let read = [("--tip-file", arguments.model.tip.tip_file.as_deref())];
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &read)?;
    if arguments.model.wider.no_spring {
        return walking::stability(arguments);
    }
    if arguments.pitch.is_some() || arguments.path.is_some() {
        return raster::stability(arguments);
    }
    if let Some(width) = arguments.width_y {
        let message = "is of a raster: give --pitch D too, or leave the option out";
        return Err(Failure::input(format!("--width-y {}", Typed(width)), message));
    }
    let tip_file = arguments.model.tip.tip_file.as_deref();
    let point = Point::asked(arguments)?;
    let scales = scales(&arguments.in_units, tip_file, Some(point.model.r()))?;
    judge_extent(arguments, &point.model)?;
    let job = Job::open::<StabilityDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    job.finish(document(arguments, &point)?.in_units(scales.as_ref()))
}

/// The critical point, and the one whose roots are listed.
struct Point {
    /// Or why there is none.
    critical: Result<Critical, StabilityError>,
    model: Model,
    /// Whether the two are the same for want of α or r.
    at_critical: bool,
    /// Whether the critical point is one of linear theory, where that may be otherwise.
    kind: Option<OnsetKind>,
}

impl Point {
    fn asked(arguments: &StabilityArguments) -> Result<Self, Failure> {
        refuse_endless(&arguments.model.tip, &arguments.model.wider)?;
        if !wider_law(&arguments.model.wider).is_papers() {
            return Self::under_wider_law(arguments);
        }
        let tip = tip(&arguments.model.tip)?;
        match arguments.solve_for {
            SolveFor::Alpha => Self::for_alpha(&arguments.model, tip),
            SolveFor::R => Self::for_r(&arguments.model, tip),
        }
    }

    fn for_alpha(arguments: &ModelArguments, tip: TipFunction) -> Result<Self, Failure> {
        let missing = "αc is a function of r: give --r R, or --alpha A --solve-for r for rc(α)";
        let r = arguments.r.ok_or_else(|| Failure::input("--r", missing))?;
        let critical = critical(&Wider::default(), &tip, r);
        if let Err(error @ StabilityError::R(_)) = critical {
            return Err(Failure::input(format!("--r {}", Typed(r)), error));
        }
        if arguments.alpha.is_some() || arguments.alpha_above.is_some() {
            return Ok(Self {
                critical,
                model: wide_model(arguments)?,
                at_critical: false,
                kind: None,
            });
        }
        let advice = "give --alpha A for the growth exponents there";
        let at = critical.map_err(|error| {
            Failure::input(format!("--r {}", Typed(r)), format!("{error}; {advice}"))
        })?;
        Self::at(at, tip)
    }

    fn for_r(arguments: &ModelArguments, tip: TipFunction) -> Result<Self, Failure> {
        if let Some(above) = arguments.alpha_above {
            let message = "αc is a function of r, which is solved for: give --alpha A";
            return Err(Failure::input(format!("--alpha-above {}", Typed(above)), message));
        }
        let missing = "rc is a function of α: give --alpha A";
        let alpha = arguments.alpha.ok_or_else(|| Failure::input("--alpha", missing))?;
        let critical = critical_r(&Wider::default(), &tip, alpha);
        if let Err(error @ StabilityError::Alpha(_)) = critical {
            return Err(Failure::input(format!("--alpha {}", Typed(alpha)), error));
        }
        if arguments.r.is_some() {
            return Ok(Self {
                critical,
                model: wide_model(arguments)?,
                at_critical: false,
                kind: None,
            });
        }
        let advice = "give --r R for the growth exponents there";
        let at = critical.map_err(|error| {
            Failure::input(format!("--alpha {}", Typed(alpha)), format!("{error}; {advice}"))
        })?;
        Self::at(at, tip)
    }

    fn at(critical: Critical, tip: TipFunction) -> Result<Self, Failure> {
        let model = Model::new(tip, critical.alpha, critical.r)
            .map_err(|error| Failure::Run(error.to_string()))?;
        Ok(Self { critical: Ok(critical), model, at_critical: true, kind: None })
    }

    fn is_stable(&self) -> Result<bool, Failure> {
        let advice = "move --alpha or --r a little";
        if self.has_corner() {
            // Small oscillations grow above αc, whatever their amplitude.
            let below = |critical: Critical| self.model.alpha() < critical.alpha;
            return Ok(!self.at_critical && self.critical.is_ok_and(below));
        }
        Ok(!self.at_critical
            && unstable_count(&self.model).map_err(|error| failed(&error, advice))? == 0)
    }
}

fn judge_extent(arguments: &StabilityArguments, model: &Model) -> Result<(), Failure> {
    let Some(bound) = arguments.re_above else {
        return judge_count("--roots", arguments.roots.unwrap_or(DEFAULT_ROOTS));
    };
    let least = leftmost(model);
    if bound.is_finite() && bound >= least {
        return Ok(());
    }
    let message = format!("must be a finite number, {least:.3} or above here");
    Err(Failure::input(format!("--re-above {}", Typed(bound)), message))
}

fn spectrum(arguments: &StabilityArguments, model: &Model) -> Result<Spectrum, Failure> {
    match arguments.re_above {
        Some(bound) => roots(model, bound).map_err(|error| match error {
            StabilityError::TooFarApart { .. } => failed(&error, ""),
            error => Failure::input(format!("--re-above {}", Typed(bound)), error),
        }),
        None => leading_roots(model, arguments.roots.unwrap_or(DEFAULT_ROOTS))
            .map_err(|error| failed(&error, "ask for another number with --roots")),
    }
}

fn document(arguments: &StabilityArguments, point: &Point) -> Result<StabilityDocument, Failure> {
    let Point { critical, model, .. } = point;
    let spectrum = if point.has_corner() { Spectrum::none() } else { spectrum(arguments, model)? };
    let asked = arguments.re_above.is_none().then(|| arguments.roots.unwrap_or(DEFAULT_ROOTS));
    let (trapping, creep) = wider::trapping(model);
    let onset = critical.and_then(|critical| wider::onset(model, critical));
    let why = |name: &str, error: Option<StabilityError>| error.map(|e| format!("{name}: {e}"));
    let mut said: Vec<String> = why("critical", critical.err())
        .into_iter()
        .chain(why("onset", onset.err().filter(|_| critical.is_ok())))
        .chain(why("trapping", trapping.err()))
        .collect();
    said.extend(why("trapping", creep.as_ref().err().copied()));
    said.dedup();
    let rates = creep.as_ref().map(|creep| creep.rates()).unwrap_or_default();
    let attracting = creep.as_ref().ok().and_then(|creep| creep.attracting());
    if !rates.is_empty() && attracting.is_none() {
        let message = "trapping: a complex pair of creep_roots lies right of every real rate: no tip stays \
                       trapped here, every stick ends in a slip";
        said.push(message.into());
    }
    if point.has_corner() {
        said.push(wider::CORNER.into());
    } else {
        said.extend(remarks(&spectrum, asked, "roots"));
    }
    let parameters = StabilityParameters {
        model: ModelParameters::of(model, arguments.model.alpha_above),
        solve_for: arguments.solve_for,
        at_critical_point: point.at_critical,
        roots: asked,
        re_above: arguments.re_above,
    };
    let creep_roots =
        creep.ok().map(|creep| creep.roots.iter().map(|p| complex(p.re, p.im)).collect());
    let creep_rates = (!rates.is_empty()).then_some(rates);
    let trapping = TrappingDocument { alpha: trapping.ok(), creep_rates, attracting, creep_roots };
    let found = StabilityFound {
        critical: critical.as_ref().ok().map(|at| CriticalDocument::of(at, point.kind)),
        onset: onset.as_ref().ok().map(OnsetDocument::from),
        limits: wider::limits(model),
        ..StabilityFound::new(point.is_stable()?, trapping, &spectrum)
    };
    Ok(Document::new(parameters, found, said))
}
