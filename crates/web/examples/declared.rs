//! Prints the parameters that the page's sliders show, as JSON: `make site` builds them into the page.

fn main() -> Result<(), serde_json::Error> {
    println!("{}", stickslip_web::declared()?);
    Ok(())
}
