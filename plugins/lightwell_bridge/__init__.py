"""What modelling programs need to talk to Lightwell, without knowing any of them: standard library and numpy only."""
