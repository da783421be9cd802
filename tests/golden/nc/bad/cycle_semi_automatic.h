; diagnostic: cycle.parameter_invalid line 4
BEGIN PGM SEMI MM
TOOL CALL 30 Z
TCH PROBE 1400 POSITION PROBING ~
    QS1100="?50+0.2-0.1" ~
    Q1101=+40 ~
    Q1102=-5 ~
    Q372=-3 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1120=+0
END PGM SEMI MM
