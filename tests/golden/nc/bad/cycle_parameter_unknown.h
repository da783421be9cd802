; diagnostic: cycle.parameter_unknown line 5
BEGIN PGM BAD MM
CYCL DEF 200 DRILLING ~
    Q200=+2 ~
    Q999=+1
END PGM BAD MM
